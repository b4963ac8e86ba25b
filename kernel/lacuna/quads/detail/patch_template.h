// SPDX-License-Identifier: MIT
#pragma once

/// Templates that fill a patch of two to six sides with grids that meet in few irregular nodes. The paver
/// uses them for its parts, the clean-up for the patches that it remeshes. Only sources of this folder
/// include it.

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::quads {

/// Maximum number of sides of a patch, or of a part of it including the cut.
constexpr std::size_t kMostSides = 6;

/// Number of nodes at even steps along an outline or a side from which lines across a region are tried. It
/// bounds the time.
inline constexpr std::size_t kPlacesTried = 32;

/// Numbers of edges along the sides of a patch.
struct SideCounts {
    std::array<int, kMostSides> side{};
    std::size_t count = 0;
};

/// The numbers of edges between the corners of a loop; corners are ascending positions in the loop.
SideCounts side_counts(std::size_t loop, std::span<const std::size_t> corners);

/// For each side of a patch of 3 or 5 sides, the position at which the grids meet on it, in edges from the
/// start of the side.
///
/// There is one grid at each corner. The grids are separated by spokes, lines of edges from a common node in
/// the middle to a node of each side. The foot of a spoke is its node on the side. The spoke that ends on
/// side i has foot[i + 1] edges, and side i has foot[i] + foot[i + 2] edges. For an odd number of sides these
/// equations have one solution.
/// @param ends_in_cut  whether the last side is a cut. Then foot[0] may be 0: the grids meet on the cut.
/// @param foot  set to the position of each foot.
/// @return  false if the solution does not consist of integers above 0.
bool spoke_feet(const SideCounts& counts, bool ends_in_cut, std::array<int, kMostSides>& foot);

/// A straight line of edges across a patch. Templates fill both parts without a further cut.
struct TemplateCut {
    std::size_t from = 0, to = 0; ///< positions in the loop
    int edges = 0;                ///< number of edges along it; 0: the patch is filled without a cut
    double fault = 0; ///< deviation from a straight line that meets the sides at right angles; 0 is best [-]
};

/// The cuts with which a loop of two to six corners is filled with the fewest irregular nodes. The best cut
/// comes first: it is straight, and meets the sides at right angles if possible. If no cut is needed, the
/// result is one "cut" without edges. If a loop of three or five corners cannot be filled with one irregular
/// node, the result contains some of the cuts that give three irregular nodes.
///
/// @param loop     points in order, with the patch on the left.
/// @param corners  positions in the loop, ascending.
/// @param most     maximum number of cuts. For cuts that join opposite sides, the maximum is half of it.
/// @note  The numbers of edges determine which cuts exist. The positions of the points rank them, and exclude
///         cuts that are slanted or have far too many or too few edges. O(product of the numbers of edges of
///         two sides).
std::vector<TemplateCut> find_cuts(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                                   std::size_t most);

/// Upper bound of the number of irregular nodes of a mesh that uses a cut of `find_cuts()`. A large number if
/// the loop does not have two to six corners.
int fewest_irregular(std::size_t loop, std::span<const std::size_t> corners);

/// Quads that fill a loop.
struct TemplateMesh {
    std::vector<Vec2> inner; ///< added points, numbered after those of the loop
    std::vector<Quad> quads; ///< counter-clockwise
    int irregular = 0;       ///< inner points whose valence is not four
};

/// Whether `fill_template()` can fill a patch of 3, 4 or 5 sides without a cut.
bool can_fill(const SideCounts& counts);

/// Fill a loop of two to six corners with few irregular nodes.
///
///      3 or 5 sides: a grid at every corner, around one node of valence 3 or 5.
///      4 sides, opposite ones equal: a grid.
///      4 sides, opposite ones unequal, without a cut: some columns turn towards the longer of the
///          two neighbouring sides, in one or both directions. Two or four irregular nodes, near the
///          middle.
///      2, 4 or 6 sides, with a cut: two parts of 3 and 3, 3 and 5 or 5 and 5 sides. Two irregular nodes.
///      3 or 5 sides, with a cut: parts of 3 and 4 or 4 and 5 sides. Three irregular nodes.
///
/// There is one quad at each corner of the loop, and there are two quads at each other point of the loop.
/// Grids are transfinite, so they follow the spacing of the loop.
/// @param loop     points in order, with the patch on the left.
/// @param corners  positions in the loop, ascending.
/// @param cut      one of the cuts of `find_cuts()`; by default, none.
/// @pre   without a cut `can_fill()`.
TemplateMesh fill_template(std::span<const Vec2> loop, std::span<const std::size_t> corners,
                           const TemplateCut& cut = {});

} // namespace lacuna::quads
