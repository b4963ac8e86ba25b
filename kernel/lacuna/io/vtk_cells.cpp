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

/// Cells by VTK's numbers.
enum class Shape { triangle, quad, polygon, pixel, strip, solid, other };
struct CellType {
    std::int64_t number;
    Shape shape;
    std::int64_t points; ///< least
};
constexpr CellType kCellTypes[] = {
    {0, Shape::other, 0},     {1, Shape::other, 1},    {2, Shape::other, 1},     {3, Shape::other, 2},
    {4, Shape::other, 2},     {5, Shape::triangle, 3}, {6, Shape::strip, 3},     {7, Shape::polygon, 3},
    {8, Shape::pixel, 4},     {9, Shape::quad, 4},     {10, Shape::solid, 4},    {11, Shape::solid, 8},
    {12, Shape::solid, 8},    {13, Shape::solid, 6},   {14, Shape::solid, 5},    {15, Shape::solid, 10},
    {16, Shape::solid, 12},   {21, Shape::other, 3},   {22, Shape::triangle, 6}, {23, Shape::quad, 8},
    {24, Shape::solid, 10},   {25, Shape::solid, 20},  {26, Shape::solid, 15},   {27, Shape::solid, 13},
    {28, Shape::quad, 9},     {29, Shape::solid, 27},  {30, Shape::quad, 6},     {31, Shape::solid, 12},
    {32, Shape::solid, 18},   {33, Shape::solid, 24},  {34, Shape::triangle, 7}, {35, Shape::other, 4},
    {37, Shape::solid, 19},   {41, Shape::solid, 4},   {42, Shape::solid, 4},    {68, Shape::other, 2},
    {69, Shape::triangle, 3}, {70, Shape::quad, 4},    {71, Shape::solid, 4},    {72, Shape::solid, 8},
    {73, Shape::solid, 6},    {74, Shape::solid, 5},   {75, Shape::other, 2},    {76, Shape::triangle, 3},
    {77, Shape::quad, 4},     {78, Shape::solid, 4},   {79, Shape::solid, 8},    {80, Shape::solid, 6},
    {81, Shape::solid, 5}};

} // namespace

const VtkType* vtk_type(std::string_view name)
{
    for (const VtkType& type : kTypes)
        if (same_word(type.legacy, name) || same_word(type.xml, name)) return &type;
    return nullptr;
}

void take_vtk_cells(const VtkCells& cells, FacetCollector& into, const Cursor& cursor)
{
    if (!cells.types.empty() && cells.types.size() != cells.ends.size())
        cursor.fail("expected a type for each of " + std::to_string(cells.ends.size()) + " cells, found " +
                    std::to_string(cells.types.size()));
    const auto fail = [&](std::size_t cell, const std::string& what) {
        cursor.fail("cell " + std::to_string(cell + 1) + ": " + what);
    };
    std::int64_t begin = 0;
    std::vector<Index> corner;
    for (std::size_t c = 0; c < cells.ends.size(); ++c) {
        const std::int64_t end = cells.ends[c];
        if (end < begin || end > static_cast<std::int64_t>(cells.points.size()))
            fail(c, "expected its points to end between " + std::to_string(begin) + " and " +
                        std::to_string(cells.points.size()) + ", found " + std::to_string(end));
        CellType type{0, cells.strips ? Shape::strip : Shape::polygon, 3};
        if (!cells.types.empty()) {
            const auto known = std::ranges::find(kCellTypes, cells.types[c], &CellType::number);
            if (known == std::end(kCellTypes))
                fail(c, "the cell type " + std::to_string(cells.types[c]) + " is not known");
            type = *known;
        }
        if (end - begin < type.points)
            fail(c, "expected " + std::to_string(type.points) + " points or more, found " +
                        std::to_string(end - begin));
        if (type.shape == Shape::solid || type.shape == Shape::other) {
            const std::string what = "cells of type " + std::to_string(type.number);
            type.shape == Shape::solid ? into.pass_over_solid(what) : into.pass_over(what);
            begin = end;
            continue;
        }
        const std::int64_t corners = type.shape == Shape::triangle                             ? 3
                                     : type.shape == Shape::quad || type.shape == Shape::pixel ? 4
                                                                                               : end - begin;
        corner.clear();
        for (std::int64_t k = begin; k < begin + corners; ++k) {
            const std::int64_t point = cells.points[static_cast<std::size_t>(k)];
            if (point < 0 || point >= cells.last_point - cells.first_point)
                fail(c, "expected one of " + std::to_string(cells.last_point - cells.first_point) +
                            " points, found number " + std::to_string(point));
            corner.push_back(cells.first_point + static_cast<Index>(point));
        }
        begin = end;
        const int label = into.label_of(1);
        if (type.shape == Shape::pixel) std::swap(corner[2], corner[3]);
        if (type.shape != Shape::strip) {
            into.add_face(corner, label, cursor);
            continue;
        }
        for (std::size_t k = 0; k + 2 < corner.size(); ++k)
            into.add_face(Triangle{corner[k], corner[k + 1 + k % 2], corner[k + 2 - k % 2]}, label, cursor);
    }
}

} // namespace lacuna::io
