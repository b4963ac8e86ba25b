// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/deck_builder.h>

#include <array>
#include <span>
#include <type_traits>

/// Common parts of legacy VTK files and VTU files. Internal to this folder.
namespace lacuna::io {

/// A number type as named by VTK in both formats.
struct VtkType {
    std::string_view legacy, xml;
    std::size_t bytes;
    /// Convert consecutive numbers.
    void (*reals)(const char* bytes, bool big, std::size_t count, double* out);
    void (*wholes)(const char* bytes, bool big, std::size_t count,
                   std::int64_t* out); ///< null for floating-point numbers
};
/// Call `take(numbers)` for consecutive numbers of an array, as many at a time as fit into the first-level
/// cache. @tparam Number  double, or std::int64_t if the type has whole numbers
template <class Number, class Take>
void each_part(const VtkType& type, std::string_view bytes, bool big, const Take& take)
{
    std::array<Number, 4096> part;
    for (std::size_t left = bytes.size() / type.bytes; left > 0;) {
        const std::size_t count = std::min(part.size(), left);
        if constexpr (std::is_integral_v<Number>)
            type.wholes(bytes.data(), big, count, part.data());
        else
            type.reals(bytes.data(), big, count, part.data());
        take(std::span<const Number>(part).first(count));
        bytes.remove_prefix(count * type.bytes);
        left -= count;
    }
}
/// The type of this name; null: the name is unknown.
const VtkType* vtk_type(std::string_view name);

/// Cells that share one list of points.
struct VtkCells {
    std::vector<std::int64_t> ends;        ///< end of each cell's points in `points`
    std::vector<Index> points;             ///< numbers from `first_point` on
    std::vector<std::int64_t> types;       ///< one per cell; empty: all are polygons
    bool strips = false;                   ///< all cells are triangle strips
    Index first_point = 0, last_point = 0; ///< range of points in the `DeckBuilder` that `points` refers to
    DeckTag first_cell = 0;                ///< first tag; only with `types`
};

/// Pass the shells and solids among the cells to the builder, with one region for each dimension. Count the
/// other cells.
/// @throw InvalidInput  a point or type is unknown, or `VtkCells::ends` do not increase; the message gives
///         the position of `cursor`.
void take_vtk_cells(const VtkCells& cells, DeckBuilder& into, const Cursor& cursor);

/// Warn that groups are not read. The writers store groups as lists of the numbers in the cell array
/// `entity`.
void note_groups(const std::vector<std::string_view>& names, DeckBuilder& into);

/// Convert wedges to the order of `mesh::Wedge`. In VTK's own order the triangle 0-1-2 faces away from 3-4-5;
/// with the opposite order VTK computes negative volumes, but Gmsh and meshio write it. The sign of the total
/// volume shows which order a file uses.
void turn_vtk_wedges(Deck& deck);

} // namespace lacuna::io
