// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// How the boundary of a region turns at a node. This decides how rows along the boundary continue there.
enum class RowTurn : char {
    smooth, ///< rows of the same table continue past the node, at any angle between its two sides
    inner,  ///< rows end there on the next boundary side, which has nodes at the rows' heights
    outer,  ///< rows end there on a new side, formed by their end nodes, perpendicular to their last side
};

/// Rows of quads at given heights along some sides of a region.
struct BoundaryRows {
    /// Tables of row heights: for each table, the heights of its rows above the side, ascending [length].
    std::vector<std::vector<double>> heights;
    /// For each boundary node, the table of the side from this node to the next; -1: no rows on this side.
    std::vector<int> table;
    std::vector<RowTurn> turn; ///< turn of the boundary at each of its nodes
    /// The scale at a position: a length in the plane, divided by the same length in the unit of `heights`.
    /// Empty: the scale is 1 everywhere.
    std::function<double(const Vec2&)> scale{};
};

/// Why rows cannot be placed.
struct RowsFinding {
    enum class Why {
        no_room,    ///< rows meet the opposite boundary or each other
        sharp_bend, ///< sides bend so much that the rows above them fold
        off_height, ///< there is no node at a row's height where the row ends
        unlike,     ///< sides with rows of two tables meet without a corner
    };
    Why why = Why::no_room;
    Index node = -1;  ///< boundary node near which the problem was found
    int table = -1;   ///< table of the rows
    double asked = 0; ///< height of the row; for `no_room`, of the topmost row [length of the heights]
    double found = 0; ///< room for rows there, or the height of the nearest node [length of the heights]
};

/// A region filled with quads, or the reason why it cannot be filled.
struct RowsFilling {
    PlanarQuads mesh;
    std::optional<RowsFinding> finding;
};

/// Place rows of quads along sides of a region and fill the rest.
///
/// Each node of a row lies above a boundary node, at the row's height above both boundary sides of this node
/// (measured perpendicular to each side).
/// - `RowTurn::inner`: the rows end on existing nodes of the next side. If this side is not perpendicular to
///   the rows, its nodes are offset along the rows. Nearby nodes of a row get the same offset, which
///   decreases with the distance from the corner. If both sides at the corner have rows, these rows cross.
/// - `RowTurn::outer`, such as at a corner of a square hole: the rows of one side continue along the ends of
///   the other side's rows.
/// @param core  mesher for the region inside the rows.
/// @return  the mesh, with the quads of the rows first. If the rows do not fit, only `finding`, the reason.
/// @throw   any exception of `core`.
/// @note    O(rows · sides), plus the filling.
RowsFilling fill_with_rows(const PlanarRegion& region, const BoundaryRows& rows, const PlanarQuadMesher& core,
                           const RunContext& context = {});

} // namespace lacuna::quads
