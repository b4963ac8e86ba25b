// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// Maximum number of runs with an odd number of sides. From each of these runs a row of double width leads to
/// another one, or a triangle with a few irregular nodes ends it. With a larger limit, more regions can be
/// coarsened, but more rows are distorted.
inline constexpr std::size_t kMostOddRuns = 8;

/// Whether a loop turns so sharply at position `place` that the node there must stay in a coarse region.
bool stays(const PlanarRegion& region, const std::vector<Index>& loop, std::size_t place);

/// A run with a whole side. Run: the part of a loop between two nodes that stay (`stays()`), or a whole loop
/// without such nodes. Whole side: a side that is also a side of the coarse region, instead of being merged
/// with its neighbour. Runs with an odd number of sides have one, others none.
struct WholeRun {
    std::vector<Index> nodes; ///< nodes of the region, including the last one
    /// Index of the run's first point in the coarse region; its points are numbered consecutively.
    Index first;

    /// Number of the run's points in the coarse region: each pair of the other sides becomes one side.
    [[nodiscard]] std::size_t points() const { return nodes.size() / 2; }
};

/// Positions at which the runs of a loop begin, in ascending order. The last entry is the end of the last
/// run: the first position plus the number of the loop's nodes. For runs see `WholeRun`.
std::vector<std::size_t> runs_of(const PlanarRegion& region, const std::vector<Index>& loop);

/// A region with every other node of the loops of a fine region. `choose_whole_sides()` selects the whole
/// sides of runs that have one; until then, the points of such a run are evenly spaced along the run.
struct CoarseRegion {
    PlanarRegion region;    ///< region with twice the size; its number of boundary sides may be odd
    std::vector<Index> own; ///< for each point of `region`, its number in the fine region
    /// For each point, the node of the fine region that was left out after it; -1: the side is whole.
    std::vector<Index> next;
    std::vector<WholeRun> runs; ///< runs with a whole side; their number is even
};

/// Make a coarse region by leaving out every other boundary node.
/// @return empty if the region has an odd number of boundary sides, or too many runs with an odd number.
std::optional<CoarseRegion> coarse_region(const PlanarRegion& region);

/// Select the whole sides of the runs of `made`. A row of quads leads from each whole side to a whole side of
/// another run; the sides are chosen so that the total length of these rows is minimal.
/// @param coarse  quads and triangles of the coarse region, with its points first.
/// @return  for each side of these cells (`mesh::opposite_sides()`), 1 if one of these rows crosses the side,
///         so that it stays whole; otherwise 0. Empty if there are no such rows.
std::optional<std::vector<char>> choose_whole_sides(CoarseRegion& made, const PlanarQuads& coarse);

/// Cut every cell of a mesh of the coarse region at the nodes that were left out: a quad into four quads, a
/// triangle into three, and a quad between whole sides into two. Other new nodes are placed halfway between
/// their neighbours.
/// @param fine    the region from which the coarse one was made; its points come first.
/// @param coarse  quads and triangles (`mesh::is_triangle()`), the coarse region's points first.
/// @param whole   sides that stay whole, from `choose_whole_sides()`
PlanarQuads cut_in_four(const PlanarRegion& fine, const CoarseRegion& made, const PlanarQuads& coarse,
                        const std::vector<char>& whole);

} // namespace lacuna::quads::paving
