// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/list_text.h>
#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/vtk_cells.h>

#include <algorithm>

namespace lacuna::io {
namespace {

template <class Value, class To>
void convert(const char* bytes, bool big, std::size_t count, To* out)
{
    if (big)
        for (std::size_t i = 0; i < count; ++i)
            out[i] = static_cast<To>(from_bytes<Value>(bytes + i * sizeof(Value), true));
    else
        for (std::size_t i = 0; i < count; ++i)
            out[i] = static_cast<To>(from_bytes<Value>(bytes + i * sizeof(Value), false));
}

template <class Value>
constexpr VtkType type_of(std::string_view legacy, std::string_view xml)
{
    VtkType type{legacy, xml, sizeof(Value), convert<Value, double>, nullptr};
    if constexpr (std::is_integral_v<Value>) type.wholes = convert<Value, std::int64_t>;
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

/// How cells of a VTK type are read: `shape` as a DeckShape, `pixel` and `voxel` likewise but from another
/// node order, `polygon` and `strip` as lists of corners that are split into faces, `other` not at all.
enum class Kind { shape, polygon, pixel, voxel, strip, other };
struct CellType {
    std::int64_t number;
    Kind kind;
    std::int64_t points; ///< minimum number of points
    DeckShape shape = DeckShape::tri3;
};
using enum DeckShape;
constexpr CellType kFurtherTypes[] = {
    {0, Kind::other, 0},
    {1, Kind::other, 1},
    {2, Kind::other, 1},
    {4, Kind::other, 2},
    {6, Kind::strip, 3},
    {7, Kind::polygon, 3},
    {8, Kind::pixel, 4, quad4},
    {11, Kind::voxel, 8, hex8},
    {15, Kind::other, 10},
    {16, Kind::other, 12},
    {30, Kind::shape, 6, quad4}, // linear in one direction, quadratic in the other
    {31, Kind::shape, 12, wedge6},
    {33, Kind::shape, 24, hex8},
    {34, Kind::shape, 7, tri6},
    {35, Kind::other, 4},
    {37, Kind::shape, 19, pyramid14},
    {41, Kind::other, 4},
    {42, Kind::other, 4},
    // Lagrange cells of any order
    {68, Kind::other, 2},
    {69, Kind::shape, 3, tri3},
    {70, Kind::shape, 4, quad4},
    {71, Kind::shape, 4, tet4},
    {72, Kind::shape, 8, hex8},
    {73, Kind::shape, 6, wedge6},
    {74, Kind::shape, 5, pyramid5},
};

std::optional<CellType> find_type(std::int64_t number)
{
    if (const auto shape = shape_numbered(&ShapeWords::vtk, number))
        return CellType{number, Kind::shape, shape_info(*shape).nodes, *shape};
    // Bézier cells have the numbers of the Lagrange cells plus seven.
    const auto known = std::ranges::find(kFurtherTypes, number >= 75 && number <= 81 ? number - 7 : number,
                                         &CellType::number);
    if (known == std::end(kFurtherTypes)) return {};
    CellType type = *known;
    type.number = number;
    return type;
}

} // namespace

const VtkType* vtk_type(std::string_view name)
{
    for (const VtkType& type : kTypes)
        if (same_word(type.legacy, name) || same_word(type.xml, name)) return &type;
    return nullptr;
}

void take_vtk_cells(const VtkCells& cells, DeckBuilder& into, const Cursor& cursor)
{
    if (!cells.types.empty() && cells.types.size() != cells.ends.size())
        cursor.fail("expected a type for each of {} cells, found {}", cells.ends.size(),
                    found(cells.types.size()));
    const auto name = [&](std::size_t cell) { return numbered("cell", cell + 1); };
    const Index count = cells.last_point - cells.first_point;
    const auto needs_points = [&](std::size_t cell, std::int64_t begin, std::int64_t end) {
        for (std::int64_t k = begin; k < end; ++k)
            if (const Index point = cells.points[static_cast<std::size_t>(k)]; point < 0 || point >= count)
                cursor.fail("{}: expected one of {} points, found number {}", name(cell), needed(count),
                            found(point));
    };
    const auto begin_of = [&](std::size_t c) { return c == 0 ? std::int64_t(0) : cells.ends[c - 1]; };
    const auto size_of = [&](std::size_t c, const CellType& type) {
        const std::int64_t begin = begin_of(c), end = cells.ends[c];
        if (end < begin || end > static_cast<std::int64_t>(cells.points.size()))
            cursor.fail("{}: expected its points to end between {} and {}, found {}", name(c), begin,
                        cells.points.size(), found(end));
        if (end - begin < type.points)
            cursor.fail("{}: expected {} points or more, found {}", name(c), needed(type.points),
                        found(end - begin));
        return end - begin;
    };
    std::vector<Index> node;
    for (std::size_t c = 0, next = 0; c < cells.ends.size(); c = next) {
        CellType type{0, cells.strips ? Kind::strip : Kind::polygon, 3};
        if (!cells.types.empty()) {
            const std::optional<CellType> known = find_type(cells.types[c]);
            if (!known) cursor.fail("{}: the cell type {} is not known", name(c), cells.types[c]);
            type = *known;
        }
        // Consecutive cells of one type are read together. Cells with lists of corners are read one by one.
        next = c + 1;
        const bool list = type.kind == Kind::polygon || type.kind == Kind::strip;
        while (!list && next < cells.ends.size() && cells.types[next] == type.number) ++next;
        if (type.kind == Kind::other) {
            for (std::size_t k = c; k < next; ++k) size_of(k, type);
            into.pass_over("cells of type " + std::to_string(type.number), next - c);
            continue;
        }
        const DeckTag tag = cells.types.empty() ? -1 : cells.first_cell + static_cast<DeckTag>(c) + 1;
        const Index region = into.region_of(1, "", list ? 2 : shape_info(type.shape).dimension);
        if (list) {
            const std::int64_t size = size_of(c, type), begin = begin_of(c);
            needs_points(c, begin, begin + size);
            node.clear();
            for (std::int64_t k = begin; k < begin + size; ++k)
                node.push_back(cells.first_point + cells.points[static_cast<std::size_t>(k)]);
            if (type.kind == Kind::polygon) {
                into.add_face(node, region, cursor, tag);
                continue;
            }
            for (std::size_t k = 0; k + 2 < node.size(); ++k)
                into.add_face(Triangle{node[k], node[k + 1 + k % 2], node[k + 2 - k % 2]}, region, cursor,
                              tag);
            continue;
        }
        const auto kept = static_cast<std::size_t>(shape_info(type.shape).nodes);
        for (std::size_t k = c; k < next; ++k) size_of(k, type);
        const std::size_t block = into.block_of(type.shape, std::to_string(type.number));
        const DeckBuilder::Room room = into.add_elements(block, next - c, region);
        Index* out = room.nodes;
        for (std::size_t k = c; k < next; ++k, out += kept) {
            const std::int64_t begin = begin_of(k);
            needs_points(k, begin, begin + static_cast<std::int64_t>(kept));
            for (std::size_t i = 0; i < kept; ++i)
                out[i] = cells.first_point + cells.points[static_cast<std::size_t>(begin) + i];
            if (type.kind == Kind::pixel || type.kind == Kind::voxel) std::swap(out[2], out[3]);
            if (type.kind == Kind::voxel) std::swap(out[6], out[7]);
            room.tags[k - c] = tag + static_cast<DeckTag>(k - c);
        }
    }
}

void note_groups(const std::vector<std::string_view>& names, DeckBuilder& into)
{
    if (!names.empty())
        into.warn(formatted("groups of VTK files are not read: {}; an .msh file keeps them",
                            short_list(names, shown)));
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
