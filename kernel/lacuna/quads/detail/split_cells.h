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
/// Every inner edge is halved, except the edges of a T-join in the dual graph. A T-join is a set of edges of
/// which an odd number meets every terminal, and an even number meets every other cell. The terminals are the
/// cells with an odd number of boundary edges, so each cell has an even number of whole edges. A nearly
/// shortest T-join is found by growing breadth-first trees from all terminals at once and joining them by a
/// minimum spanning tree. Without whole edges, a quad is cut into four quads and a triangle into three. With
/// two whole edges, a quad is cut into two or three quads and a triangle into five. All corners of the quads
/// stay below a straight angle if those of the cells are.
/// @pre   the boundary has an even number of edges; cells are convex, conforming and in one piece.
/// @note  Deterministic. O(cells log cells).
MixedMesh split_cells(const MixedMesh& mesh);

} // namespace lacuna::quads
