// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/vtk_cells.h>

#include <algorithm>
#include <type_traits>

namespace lacuna::io {
namespace {

template <class Value>
constexpr VtkType type_of(std::string_view legacy, std::string_view xml)
{
    VtkType type{
        legacy, xml, sizeof(Value),
        [](const char* bytes, bool big) { return static_cast<double>(from_bytes<Value>(bytes, big)); },
        nullptr};
    if constexpr (std::is_integral_v<Value>)
        type.whole = [](const char* bytes, bool big) {
            return static_cast<std::int64_t>(from_bytes<Value>(bytes, big));
        };
    return type;
}

constexpr VtkType kTypes[] = {
    type_of<float>("float", "Float32"),        type_of<double>("double", "Float64"),
    type_of<std::int8_t>("char", "Int8"),      type_of<std::uint8_t>("unsigned_char", "UInt8"),
    type_of<std::int16_t>("short", "Int16"),   type_of<std::uint16_t>("unsigned_short", "UInt16"),
    type_of<std::int32_t>("int", "Int32"),     type_of<std::uint32_t>("unsigned_int", "UInt32"),
    type_of<std::int64_t>("long", "Int64"),    type_of<std::uint64_t>("unsigned_long", "UInt64"),
    type_of<std::int64_t>("vtktypeint64", ""), type_of<std::uint64_t>("vtktypeuint64", ""),
    type_of<std::int32_t>("vtktypeint32", ""), type_of<std::int64_t>("vtkIdType", "")};

/// Cells by VTK's numbers: shapes that are kept, those that are cut into faces, lists of corners,
/// and others.
enum class Kind { shape, polygon, pixel, voxel, strip, other };
struct CellType {
    std::int64_t number;
    Kind kind;
    std::int64_t points; ///< least
    DeckShape shape = DeckShape::tri3;
};
using enum DeckShape;
constexpr CellType kCellTypes[] = {{0, Kind::other, 0},
                                   {1, Kind::other, 1},
                                   {2, Kind::other, 1},
                                   {3, Kind::other, 2},
                                   {4, Kind::other, 2},
                                   {5, Kind::shape, 3, tri3},
                                   {6, Kind::strip, 3},
                                   {7, Kind::polygon, 3},
                                   {8, Kind::pixel, 4, quad4},
                                   {9, Kind::shape, 4, quad4},
                                   {10, Kind::shape, 4, tet4},
                                   {11, Kind::voxel, 8, hex8},
                                   {12, Kind::shape, 8, hex8},
                                   {13, Kind::shape, 6, wedge6},
                                   {14, Kind::shape, 5, pyramid5},
                                   {15, Kind::other, 10},
                                   {16, Kind::other, 12},
                                   {21, Kind::other, 3},
                                   {22, Kind::shape, 6, tri6},
                                   {23, Kind::shape, 8, quad8},
                                   {24, Kind::shape, 10, tet10},
                                   {25, Kind::shape, 20, hex20},
                                   {26, Kind::shape, 15, wedge15},
                                   {27, Kind::shape, 13, pyramid13},
                                   {28, Kind::shape, 9, quad9},
                                   {29, Kind::shape, 27, hex27},
                                   {30, Kind::shape, 6, quad4}, // linear across, quadratic along
                                   {31, Kind::shape, 12, wedge6},
                                   {32, Kind::shape, 18, wedge18},
                                   {33, Kind::shape, 24, hex8},
                                   {34, Kind::shape, 7, tri6},
                                   {35, Kind::other, 4},
                                   {37, Kind::shape, 19, pyramid14},
                                   {41, Kind::other, 4},
                                   {42, Kind::other, 4},
                                   {68, Kind::other, 2},
                                   // Of any order: Lagrange, then Bézier.
                                   {69, Kind::shape, 3, tri3},
                                   {70, Kind::shape, 4, quad4},
                                   {71, Kind::shape, 4, tet4},
                                   {72, Kind::shape, 8, hex8},
                                   {73, Kind::shape, 6, wedge6},
                                   {74, Kind::shape, 5, pyramid5},
                                   {75, Kind::other, 2},
                                   {76, Kind::shape, 3, tri3},
                                   {77, Kind::shape, 4, quad4},
                                   {78, Kind::shape, 4, tet4},
                                   {79, Kind::shape, 8, hex8},
                                   {80, Kind::shape, 6, wedge6},
                                   {81, Kind::shape, 5, pyramid5}};

} // namespace

const VtkType* vtk_type(std::string_view name)
{
    for (const VtkType& type : kTypes)
        if (same_word(type.legacy, name) || same_word(type.xml, name)) return &type;
    return nullptr;
}

int vtk_type_of(DeckShape shape)
{
    for (const CellType& type : kCellTypes)
        if (type.kind == Kind::shape && type.shape == shape && type.points == shape_info(shape).nodes)
            return static_cast<int>(type.number);
    return 0; // of lines, which are not written
}

void take_vtk_cells(const VtkCells& cells, DeckBuilder& into, const Cursor& cursor)
{
    if (!cells.types.empty() && cells.types.size() != cells.ends.size())
        cursor.fail("expected a type for each of " + std::to_string(cells.ends.size()) + " cells, found " +
                    std::to_string(cells.types.size()));
    const auto fail = [&](std::size_t cell, const std::string& what) {
        cursor.fail("cell " + std::to_string(cell + 1) + ": " + what);
    };
    std::int64_t begin = 0;
    std::vector<Index> node;
    std::int64_t last_type = -1;
    std::size_t block = 0;
    for (std::size_t c = 0; c < cells.ends.size(); ++c) {
        const std::int64_t end = cells.ends[c];
        if (end < begin || end > static_cast<std::int64_t>(cells.points.size()))
            fail(c, "expected its points to end between " + std::to_string(begin) + " and " +
                        std::to_string(cells.points.size()) + ", found " + std::to_string(end));
        CellType type{0, cells.strips ? Kind::strip : Kind::polygon, 3};
        if (!cells.types.empty()) {
            const auto known = std::ranges::find(kCellTypes, cells.types[c], &CellType::number);
            if (known == std::end(kCellTypes))
                fail(c, "the cell type " + std::to_string(cells.types[c]) + " is not known");
            type = *known;
        }
        if (end - begin < type.points)
            fail(c, "expected " + std::to_string(type.points) + " points or more, found " +
                        std::to_string(end - begin));
        if (type.kind == Kind::other) {
            into.pass_over("cells of type " + std::to_string(type.number));
            begin = end;
            continue;
        }
        const bool list = type.kind == Kind::polygon || type.kind == Kind::strip;
        const std::int64_t kept = list ? end - begin : shape_info(type.shape).nodes;
        node.clear();
        for (std::int64_t k = begin; k < begin + kept; ++k) {
            const std::int64_t point = cells.points[static_cast<std::size_t>(k)];
            if (point < 0 || point >= cells.last_point - cells.first_point)
                fail(c, "expected one of " + std::to_string(cells.last_point - cells.first_point) +
                            " points, found number " + std::to_string(point));
            node.push_back(cells.first_point + static_cast<Index>(point));
        }
        begin = end;
        const DeckTag tag = cells.types.empty() ? -1 : cells.first_cell + static_cast<DeckTag>(c) + 1;
        const int dimension = list ? 2 : shape_info(type.shape).dimension;
        const Index region = into.region_of(1, "", dimension);
        if (type.kind == Kind::pixel || type.kind == Kind::voxel) std::swap(node[2], node[3]);
        if (type.kind == Kind::voxel) std::swap(node[6], node[7]);
        if (!list) {
            if (type.number != last_type) {
                last_type = type.number;
                block = into.block_of(type.shape, std::to_string(type.number));
            }
            into.add_element(block, tag, region, node);
        } else if (type.kind == Kind::polygon) {
            into.add_face(node, region, cursor, tag);
        } else {
            for (std::size_t k = 0; k + 2 < node.size(); ++k)
                into.add_face(Triangle{node[k], node[k + 1 + k % 2], node[k + 2 - k % 2]}, region, cursor,
                              tag);
        }
    }
}

void turn_vtk_wedges(Deck& deck)
{
    double volume = 0;
    const auto each = [&](const auto& visit) {
        for (DeckBlock& block : deck.blocks) {
            if (block.shape != DeckShape::wedge6) continue;
            for (std::size_t e = 0; e < block.count(); ++e) visit(block.nodes.data() + 6 * e);
        }
    };
    each([&](const Index* n) {
        const auto at = [&](std::size_t k) -> const Vec3& { return deck.points[index(n[k])]; };
        const Vec3 up = at(3) + at(4) + at(5) - at(0) - at(1) - at(2);
        volume += (at(1) - at(0)).cross(at(2) - at(0)).dot(up);
    });
    if (!(volume < 0)) return;
    each([](Index* n) {
        std::swap(n[1], n[2]);
        std::swap(n[4], n[5]);
    });
}

} // namespace lacuna::io
