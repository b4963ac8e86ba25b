// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_builder.h>

/// What legacy VTK files and VTU files share. Internal to this folder.
namespace lacuna::io {

/// A type of numbers as VTK names it, in either format.
struct VtkType {
    std::string_view legacy, xml;
    std::size_t bytes;
    double (*real)(const char* bytes, bool big);
    std::int64_t (*whole)(const char* bytes, bool big); ///< null for floating-point numbers
};
/// Null where the name is unknown.
const VtkType* vtk_type(std::string_view name);
/// VTK's number of a shape.
int vtk_type_of(DeckShape shape);

/// Cells over one list of points.
struct VtkCells {
    std::vector<std::int64_t> ends;        ///< where each cell's points end in `points`
    std::vector<std::int64_t> points;      ///< numbers from `first_point` on
    std::vector<std::int64_t> types;       ///< one each; empty: all are polygons
    bool strips = false;                   ///< all are triangle strips
    Index first_point = 0, last_point = 0; ///< which of the collector's points they count, [first, last)
    DeckTag first_cell = 0;                ///< tags count on from it; of `types` alone
};

/// Hand shells and solids among the cells to the builder; others are counted. One region holds all
/// of a dimension.
/// @throw InvalidInput  a point or a type that is not there, ends that do not rise; `cursor` says where.
void take_vtk_cells(const VtkCells& cells, DeckBuilder& into, const Cursor& cursor);

} // namespace lacuna::io
