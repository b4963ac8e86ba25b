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
    /// Many of them, one after the other.
    void (*reals)(const char* bytes, bool big, std::size_t count, double* out);
    void (*wholes)(const char* bytes, bool big, std::size_t count,
                   std::int64_t* out); ///< null for floating-point numbers
};
/// Append whole numbers as places. @return  the first that is no `Index` and ends it; 0: all are.
std::int64_t append_places(const VtkType& type, std::string_view bytes, bool big, std::vector<Index>& places);
/// Null where the name is unknown.
const VtkType* vtk_type(std::string_view name);

/// Cells over one list of points.
struct VtkCells {
    std::vector<std::int64_t> ends;        ///< where each cell's points end in `points`
    std::vector<Index> points;             ///< numbers from `first_point` on
    std::vector<std::int64_t> types;       ///< one each; empty: all are polygons
    bool strips = false;                   ///< all are triangle strips
    Index first_point = 0, last_point = 0; ///< which of the collector's points they count, [first, last)
    DeckTag first_cell = 0;                ///< tags count on from it; of `types` alone
};

/// Hand shells and solids among the cells to the builder; others are counted. One region holds all
/// of a dimension.
/// @throw InvalidInput  a point or a type that is not there, ends that do not rise; `cursor` says where.
void take_vtk_cells(const VtkCells& cells, DeckBuilder& into, const Cursor& cursor);

/// Bring wedges into the order of `mesh::Wedge`. VTK's own has the triangle 0-1-2 look away from 3-4-5, and
/// VTK's volumes are negative otherwise; Gmsh and meshio write wedges the other way round all the same. Which
/// of the two a file means is told by the sum of their volumes.
void turn_vtk_wedges(Deck& deck);

} // namespace lacuna::io
