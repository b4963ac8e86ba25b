// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A segment of a region's boundary and the number of sides it should get.
struct BoundarySegment {
    double wanted = 1;  ///< number of sides that the size requires, not rounded, > 0
    int least = 1;      ///< minimum number of sides, >= 1
    bool fixed = false; ///< whether the current number of sides is given and must not change
};

/// The even number nearest to `wanted` that is at least `least`.
int even_sides(double wanted, int least);

/// Above this number of quads, `pave()` first paves with a quarter as many quads and then refines the mesh.
/// It does not make meshes of this size symmetric. Both limit the time.
inline constexpr double kManyQuads = 20'000;
/// A segment whose number of sides is smaller need not have an even number, because rounding would change its
/// edge length too much.
inline constexpr double kFewestEven = 8;

/// Numbers of sides with which `fill_patterns()` fills a region by one grid (interval assignment).
///
/// The function minimises Σ (n − wanted)² / n over whole numbers n of sides. Every loop must close in the
/// grid: it has as many sides in each direction as in the opposite direction. Fixed segments keep their
/// numbers. Segments that repeat along a loop get equal numbers if possible. Grids are tried in this order:
///
/// 1. A ring grid around a hole, whose outer loop and hole have equal numbers of sides. It is used if the
///    sides of both loops are then 0.6 to 1.6 times as long as requested. A ring that is narrow on one side
///    gets fewer rows there. For each row less, the outer loop has two sides more than the hole.
/// 2. If a loop repeats the same segments: one side of the outer loop from each corner to the next, and as
///    many sides of the hole, up to four times the requested number.
/// 3. A ring whose loops differ by a multiple of four. Rows that change their number of sides at two places
///    take up the difference.
/// 4. A straight grid. A segment with four or more wanted sides is changed by less than a quarter.
///
/// If reflections of a symmetric region map segments onto segments, the numbers respect these reflections and
/// leave a node on every mirror axis. They are computed for the part between two axes, or on one side of a
/// single axis, and the axes are free segments of this part. A region whose centre lies on several axes gets
/// numbers that respect all of them, rounded if no grid has such numbers.
///
/// For a straight grid the sum has three more terms:
/// - a quarter of (quads − requested)² / requested, because rows in front of round turns add quads;
/// - for each round turn, ln²(rows / fitting rows), times half the fitting rows if these are more than two.
///   Fitting rows fill about a third of the radius of the widest turn;
/// - a penalty for unequal numbers if the part itself is symmetric.
///
/// The sum is evaluated for solutions that start from several multiples of the wanted numbers, and for
/// several numbers of rows. If a straight grid of a region without axes has too many or too few quads, other
/// multiples of the wanted numbers are rounded.
///
/// Below 200 quads, there are these differences:
/// - The axes are divided by the requested size instead of a size that is graded away from short sides.
/// - Parts between other axes are tried as well.
/// - The grid of a part must have room for its holes, with grid lines between them. If there is no such grid,
///   segments may deviate as much as on a ring.
/// - For a straight grid of a region without axes, a grid is made for each of the four cheapest solutions,
///   including those with fewer soft turns. The numbers of the grid with the best measured quality are used.
///
/// A region of three or five sides that no grid fills gets numbers for three or five grids around one node.
/// The wanted numbers are scaled, because such grids would have too many or too few quads.
///
/// Above `kManyQuads` quads, every other node between corners must be removable, so that `pave()` can coarsen
/// the region. Otherwise segments get twice the numbers that they would get with twice the size, unless some
/// numbers are fixed or some segments are short.
///
/// The equations of a loop have coefficients of 1 and -1, and a number occurs in two equations only if its
/// segment turns. Therefore it is enough to round the wanted numbers and to change numbers by one, the
/// cheapest change first, until all equations hold. A hole then gets one row or column more or less if this
/// keeps its centre at its place in the outer loop's grid, which preserves symmetry. Below 200 quads, the
/// numbers without this change are tried too.
/// @param region   the region with its current nodes, whose number does not matter.
/// @param segment  segment of the side from each boundary node to the next.
/// @return  the number of sides of every segment; empty if no grid fits.
/// @throw Cancelled
/// @note  Deterministic. O(nodes · segments).
std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments,
                                               const RunContext& context = {});

} // namespace lacuna::quads
