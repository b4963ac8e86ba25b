// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <vector>

namespace lacuna::mesh {

///   3-----2
///   |     |    Nodes of a quad, counter-clockwise seen from where its normal points to.
///   |     |    Side i runs from node i to node (i + 1) % 4.
///   0-----1
///
/// Where triangles are allowed, a triangle is a quad with its last corner repeated: {a, b, c, c}. Its sides
/// are 0, 1 and 3; side 2 does not exist.
struct QuadMesh {
    std::vector<Vec3> nodes; ///< [model length]
    std::vector<Quad> quads; ///< node numbers, counter-clockwise
    std::vector<Index> face; ///< a label of the caller for each quad, such as its face
    /// Boundary loops as node cycles, with the region on the left; the first node is not repeated.
    std::vector<std::vector<Index>> loops;
};

constexpr bool is_triangle(const Quad& quad) { return quad[2] == quad[3]; }
constexpr std::size_t corner_count(const Quad& quad) { return is_triangle(quad) ? 3 : 4; }
/// Whether side `k` exists: side 2 of a triangle does not. The third side of a triangle is side 3.
constexpr bool is_side(const Quad& quad, std::size_t k) { return k != 2 || !is_triangle(quad); }
/// The same quad with its orientation reversed.
constexpr Quad turned_over(const Quad& quad)
{
    return is_triangle(quad) ? Quad{quad[1], quad[0], quad[2], quad[2]}
                             : Quad{quad[0], quad[3], quad[2], quad[1]};
}

/// A directed side that belongs to one quad only, and the quad.
struct BoundarySide {
    Index from, to, quad;
};

/// The sides that no other quad shares, directed as in their quad, in the order of the quads. O(quads).
/// @pre no corner is negative
std::vector<BoundarySide> boundary_sides(const std::vector<Quad>& quads);

/// Values of `opposite_sides()` for sides without a partner.
inline constexpr Index kRimSide = -1; ///< on the boundary: no other quad has the side
inline constexpr Index kBadSide = -2; ///< three or more quads have the side, or two in the same direction
inline constexpr Index kNoSide = -3;  ///< side 2 of a triangle

/// The partner of each side: the number of the side of the neighbouring quad that has the same nodes in the
/// opposite direction. `kRimSide`, `kBadSide` or `kNoSide` if there is none. Side i of quad q has the number
/// 4q + i. O(quads).
/// @pre every corner lies in [0, node_count)
std::vector<Index> opposite_sides(const std::vector<Quad>& quads, Index node_count);

} // namespace lacuna::mesh
