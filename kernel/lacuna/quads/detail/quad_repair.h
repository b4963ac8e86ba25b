// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <vector>

namespace lacuna::quads {

/// Quads and triangles of the plane, counter-clockwise; the last corner of a triangle is -1. The first
/// `fixed` points are the boundary's and stay where they are.
struct MixedMesh {
    std::vector<Vec2> points;
    std::vector<Quad> cells;
    std::size_t fixed = 0;

    [[nodiscard]] static bool is_triangle(const Quad& cell) { return cell[3] < 0; }
    [[nodiscard]] const Vec2& at(Index p) const { return points[static_cast<std::size_t>(p)]; }
};

/// Least scaled Jacobian at the corners of a quad: 1 for a rectangle, above 0 where it is convex.
double scaled_jacobian(const MixedMesh& mesh, const Quad& quad);

/// Make quads of neighbouring triangles, as many as go, the best pairs first. Some triangles may be left.
void match_triangles(MixedMesh& mesh);

/// Make quads of the triangles, two by two: one walks towards the other through the quads between them, each
/// step dividing a triangle and a quad, which make a pentagon, anew. Of an odd number one is left.
void pair_triangles(MixedMesh& mesh);

/// Cut every cell at its centre and the middles of its sides: 4 quads of a quad, 3 of a triangle.
/// @param middles  of the boundary sides (a, b): triples a, b, middle; the middle is the number of a fixed
///                  point.
/// @param fixed    the boundary points of the result, those numbers refer to; `points_of` tells which of
///                 them each fixed point of `mesh` is.
MixedMesh subdivide(const MixedMesh& mesh, const std::vector<Triangle>& middles,
                    const std::vector<Vec2>& fixed, const std::vector<Index>& points_of);

/// Better quads without touching the boundary: points with two quads alone go, sides turn where that helps
/// the worst of the two quads, and inner points move to where the worst around them is best.
void improve(MixedMesh& mesh);

} // namespace lacuna::quads
