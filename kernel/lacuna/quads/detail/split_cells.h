// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <vector>

namespace lacuna::quads {

/// Quads and triangles of the plane, counter-clockwise. Triangles are stored as for `mesh::is_triangle()`.
/// The first `fixed` points are on the boundary and do not move.
struct MixedMesh {
    std::vector<Vec2> points;
    std::vector<Quad> cells;
    std::size_t fixed = 0;

    [[nodiscard]] const Vec2& at(Index p) const { return points[index(p)]; }
};

/// Cut convex cells into convex quads without changing the boundary. This always works, so it is used for
/// regions in which rows and cuts fail.
///
/// Inner edges are halved, except those crossed by a T-join of the dual graph. These edges and the boundary
/// edges stay whole. The T-join meets a cell with an odd number of boundary edges (a terminal) an odd number
/// of times, and any other cell an even number of times. So every cell has an even number of whole edges. A
/// nearly shortest T-join is found by growing breadth-first trees from all terminals at once and joining them
/// by a minimum spanning tree.
///
/// Depending on its number of whole edges, a cell is cut as follows:
/// - none: a quad into four quads, a triangle into three;
/// - two: a quad into two or three quads, a triangle into five;
/// - four: a quad stays as it is.
///
/// If all corners of the cells are below a straight angle, so are those of the quads.
/// @pre   the boundary has an even number of edges; cells are convex, conforming and in one piece.
/// @note  Deterministic. O(cells log cells).
MixedMesh split_cells(const MixedMesh& mesh);

} // namespace lacuna::quads
