// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::quads {

/// How a region's boundary turns at a node, for the rows along it.
enum class RowTurn : char {
    smooth, ///< rows of one table go on past it, however far the two sides turn
    inner,  ///< rows end there on the sides beyond, which have nodes at their heights
    outer,  ///< rows end there on a side of their own, square to the last of the boundary's
};

/// Rows of quads at given heights along some sides of a region.
struct BoundaryRows {
    std::vector<std::vector<double>> heights; ///< of each table: of its rows over the side, rising [length]
    /// Of the side from each boundary node to the next in its loop: its table, or -1 for none.
    std::vector<int> table;
    std::vector<RowTurn> turn; ///< of each boundary node
    /// Lengths in the plane over those that heights are given in, at a place; empty: 1.
    std::function<double(const Vec2&)> scale{};
};

/// Why rows cannot be laid.
struct RowsFinding {
    enum class Why {
        no_room,    ///< rows meet what lies opposite, or each other
        sharp_bend, ///< sides bend so much that rows fold over them
        off_height, ///< where rows end there is no node at their height
        unlike,     ///< sides with rows of two tables go on into each other without a corner
    };
    Why why = Why::no_room;
    Index node = -1;  ///< of the boundary, near which it was found
    int table = -1;   ///< of the rows
    double asked = 0; ///< height of the row, of all rows for `no_room` [length of the heights]
    double found = 0; ///< room for rows there, or the height of the node nearest to it
};

/// A region filled with quads, or why it cannot be.
struct RowsFilling {
    PlanarQuads mesh;
    std::optional<RowsFinding> finding;
};

/// Lay rows of quads along sides of a region, and fill what is inside them.
///
/// Nodes of row j stand at the height j of their table over both sides at their foot, measured square to
/// them. At a corner where rows end, the ends of the rows are the boundary's nodes there, and rows near it
/// lean as these do. Where sides with rows meet in a corner, the rows of both cross there. At a corner that
/// turns outward of the region the rows of one side go on along the ends of the other's.
/// @param core  fills what is left inside the rows.
/// @return  quads of rows first; a finding where the rows do not fit.
/// @throw   what `core` throws.
/// @note    O(rows · sides), and the filling.
RowsFilling fill_with_rows(const PlanarRegion& region, const BoundaryRows& rows, const PlanarQuadMesher& core,
                           const RunContext& context = {});

} // namespace lacuna::quads
