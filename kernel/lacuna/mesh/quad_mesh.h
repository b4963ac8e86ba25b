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
/// Where triangles are allowed, a triangle is a quad whose last corner stands twice: {a, b, c, c}. Its sides
/// are 0, 1 and 3; side 2, between the two, is none.
struct QuadMesh {
    std::vector<Vec3> nodes; ///< [model length]
    std::vector<Quad> quads; ///< node numbers, counter-clockwise
    std::vector<Index> face; ///< a caller's label for each quad (which face it lies on)
    /// Node cycles of the boundary, region on the left, first not repeated.
    std::vector<std::vector<Index>> loops;
};

constexpr bool is_triangle(const Quad& quad) { return quad[2] == quad[3]; }
constexpr std::size_t corner_count(const Quad& quad) { return is_triangle(quad) ? 3 : 4; }
/// Whether side `k` is one: all are, but the third of a triangle. Its third edge is side 3.
constexpr bool is_side(const Quad& quad, std::size_t k) { return k != 2 || !is_triangle(quad); }
/// The same corners seen from behind.
constexpr Quad turned_over(const Quad& quad)
{
    return is_triangle(quad) ? Quad{quad[1], quad[0], quad[2], quad[2]}
                             : Quad{quad[0], quad[3], quad[2], quad[1]};
}

/// Directed sides used by one quad alone, each with its quad.
struct BoundarySide {
    Index from, to, quad;
};

/// The sides of `quads` that no other quad shares, as directed in their quad, in order of quad. O(quads).
/// @pre no corner is negative
std::vector<BoundarySide> boundary_sides(const std::vector<Quad>& quads);

/// What `opposite_sides()` says of a side without a partner.
inline constexpr Index kRimSide = -1; ///< no other quad has it: it lies on the boundary
inline constexpr Index kBadSide = -2; ///< three quads or more have it, or two run it in the same direction
inline constexpr Index kNoSide = -3;  ///< side 2 of a triangle

/// Partner of every side, side i of quad q having the number 4q + i: the same side run the other way in the
/// neighbouring quad, or `kRimSide`, `kBadSide` or `kNoSide`. O(quads).
/// @pre every corner lies in [0, node_count)
std::vector<Index> opposite_sides(const std::vector<Quad>& quads, Index node_count);

} // namespace lacuna::mesh
