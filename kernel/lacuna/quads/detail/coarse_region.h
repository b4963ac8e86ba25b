// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::quads::paving {

/// Whether a loop turns so much at its node at `place` that the node is not left out.
bool stays(const PlanarRegion& region, const std::vector<Index>& loop, std::size_t place);

/// A part of a loop between two nodes that stay, or a whole loop, some of whose sides stay whole: an odd
/// number where it has an odd number of sides.
struct WholeRun {
    std::vector<Index> nodes; ///< of the region, the last one too
    Index first;              ///< of its points in the coarse region, which follow each other
    std::size_t whole;        ///< sides, > 0

    /// How many those points are: two of its other sides become one.
    [[nodiscard]] std::size_t points() const { return (nodes.size() - 1 + whole) / 2; }
};

/// Where the runs of a loop begin, rising, and behind them where the last one ends: the first place once
/// more, counted on. They run from node that stays to node that stays; a loop without such nodes is one run.
std::vector<std::size_t> runs_of(const PlanarRegion& region, const std::vector<Index>& loop);

/// A region with every other node of its loops. Sides of some runs are whole: sides of the coarse region as
/// they are. Until `choose_whole_sides()` says which, the points of such a run lie evenly along it.
struct CoarseRegion {
    PlanarRegion region;        ///< of twice the size; may have an odd number of boundary sides
    std::vector<Index> own;     ///< its points in the region it was made of
    std::vector<Index> next;    ///< there: the node left out after each of its points; -1: the side is whole
    std::vector<WholeRun> runs; ///< with whole sides, an even number in all
};

/// Who has whole sides beside runs with an odd number of sides.
enum class WholeSides {
    of_odd_runs, ///< nobody; those have one each
    of_outline,  ///< the longest run of the outer loop has as many as all others
};

/// Leave every other boundary node out.
/// @return nothing where the region has an odd number of boundary sides, or many odd runs.
std::optional<CoarseRegion> coarse_region(const PlanarRegion& region,
                                          WholeSides sides = WholeSides::of_odd_runs);

/// Choose the whole sides of every run that has some: so that from each a row of quads leads to that of
/// another run, the shortest rows in all. Without such runs there is nothing to choose.
/// @param coarse  quads and triangles of the coarse region, its points first.
/// @return for each side of those (`mesh::opposite_sides()`), whether it is whole: those that these rows
///         cross. Nothing where no rows lead so.
std::optional<std::vector<char>> choose_whole_sides(CoarseRegion& made, const PlanarQuads& coarse);

/// Cut every cell of a mesh of the coarse region into four quads, a triangle into three, through the nodes
/// that were left out; one between whole sides into two. Other nodes are put half way between their
/// neighbours.
/// @param fine    the region that the coarse one was made of; its points come first.
/// @param coarse  quads and triangles (`mesh::is_triangle()`), the coarse region's points first.
/// @param whole   sides that stay whole, as `choose_whole_sides()` has them
PlanarQuads cut_in_four(const PlanarRegion& fine, const CoarseRegion& made, const PlanarQuads& coarse,
                        const std::vector<char>& whole);

} // namespace lacuna::quads::paving
