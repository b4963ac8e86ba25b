// SPDX-License-Identifier: MIT
#pragma once

/// Templates that fill a patch of two to six sides with grids that meet in few irregular nodes. The paver
/// fills its parts with them, the clean-up the patches that it meshes anew. Only sources of this folder
/// include it.

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Sides of a patch, or of a part of it with the cut, at most.
constexpr std::size_t kMostSides = 6;

/// Numbers of edges along the sides of a patch.
struct SideCounts {
    std::array<int, kMostSides> side{};
    std::size_t count = 0;
};

/// The counts of a loop cut into sides at its corners, which are positions in the loop, rising.
SideCounts side_counts(std::size_t loop, std::span<const std::size_t> corners);

/// Where the grids of a patch of 3 or 5 sides meet on each side, in edges from the side's start.
///
/// One grid lies at each corner, and lines from a node in the middle, the spokes, part them. The spoke that
/// ends on side i has foot[i + 1] edges, and side i is foot[i] + foot[i + 2] long; for an odd number of sides
/// that has one solution.
/// @param ends_in_cut  the last side is a cut: the first foot may be 0 then, and the grids meet on the cut.
/// @return false where the solution is not in whole numbers above 0.
bool spoke_feet(const SideCounts& counts, bool ends_in_cut, std::array<int, kMostSides>& foot);

/// A straight line of edges across a patch; the parts on either side are filled without another one.
struct TemplateCut {
    std::size_t from = 0, to = 0; ///< positions in the loop
    int edges = 0;                ///< along it; 0: the patch is filled without a cut
    double fault = 0;             ///< the less, the straighter and squarer [-]
};

/// The cuts with which a loop of two to six corners is filled with the fewest irregular nodes, the likeliest
/// first: straight and square to the sides where possible. One "cut" without edges where none is needed. Of
/// three or five corners, where one irregular node does not do, some of those with which three do.
///
/// @param loop     in order, the patch on the left.
/// @param corners  positions in the loop, rising.
/// @param most     cuts at most; half as many between sides that face each other.
/// @note  The numbers of edges say which cuts there are. Where the points lie ranks them, and leaves out
///        those that slant or have far too many or too few edges. O(product of the numbers of edges of two
///        sides).
std::vector<TemplateCut> find_cuts(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                                   std::size_t most);

/// Irregular nodes, at most, of what the cuts of `find_cuts()` give, where it finds one; a large number for
/// other numbers of corners.
int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners);

/// Quads that fill a loop.
struct TemplateMesh {
    std::vector<Vec2> inner; ///< points added; they have the numbers after the loop's
    std::vector<Quad> quads; ///< counter-clockwise
    int irregular = 0;       ///< inner points without four quads
};

/// Whether `fill_template()` fills a patch of 3, 4 or 5 sides without a cut.
bool can_fill(const SideCounts& counts);

/// Fill a loop of two to six corners with few irregular nodes.
///
///      3 or 5 sides: a grid for every corner, around one node of three or five quads. 4 sides, opposite ones
///      alike: a grid. 4 sides, without a cut: columns that turn off to the longer neighbour, in one or both
///      ways. Two or four irregular
///          nodes, near the middle.
///      2, 4 or 6 sides, with a cut: two parts of 3 and 3, 3 and 5 or 5 and 5 sides. Two irregular nodes.
///      3 or 5 sides, with a cut: parts of 3 and 4 or 4 and 5 sides. Three irregular nodes.
///
/// At a corner there is one quad of the patch, at other points of the loop two. Grids are transfinite, so
/// that they follow the spacing of the loop.
/// @param loop     in order, the patch on the left.
/// @param corners  positions in the loop, rising.
/// @param cut      one of `find_cuts()`, or none.
/// @pre   without a cut `can_fill()`.
TemplateMesh fill_template(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                           const TemplateCut& cut = {});

} // namespace lacuna::quads
