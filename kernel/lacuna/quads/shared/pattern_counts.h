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
    bool fixed = false; ///< whether the number of sides is given
};

/// The even number nearest to `wanted` that is at least `least`.
int even_sides(double wanted, int least);

/// Above this number of quads, `pave()` paves with a quarter as many, refines the mesh, and keeps no
/// symmetry, to limit the time.
inline constexpr double kManyQuads = 20'000;
/// A segment with fewer sides than this is not forced to an even number, because rounding would change its
/// edge length too much.
inline constexpr double kFewestEven = 8;

/// Numbers of sides with which `fill_patterns()` fills a region by one grid (interval assignment).
///
/// The function minimises Σ (n − wanted)² / n over whole numbers n for which every loop closes in the grid:
/// as many sides in one direction as back; around a hole, as many on the outer loop as on the hole. Fixed
/// segments keep their numbers. A ring grid is used if the sides of both its loops are then 0.6 to 1.6 times
/// as long as asked; segments that repeat along a loop get equal numbers if possible. If a ring is narrow on
/// one side, its outer loop has two more sides for each row by which it steps in there. If one loop has many
/// corners and repeats itself all round, it has one side per corner, and the other loop as many, up to four
/// times as many as asked. Otherwise the loops of a ring differ by a multiple of four, and rows that change
/// their number of sides at two places take up the difference. If none of these is possible the grid is
/// straight, and a segment that asks for four sides or more is changed by less than a quarter.
///
/// If reflections of a symmetric region map segments onto segments, the numbers respect these reflections and
/// leave a node on every mirror axis. They are found for the part between two axes, or on one side of the
/// only axis; the axes are free segments of the part. For a straight grid the sum has more terms: (quads −
/// asked)² / asked, times a quarter, because rows before round turns add quads; ln²(rows / fitting rows) for
/// each such turn; and a penalty for unequal numbers if the part is symmetric itself. The function evaluates
/// the sum for closed loops that start from several multiples of the wanted numbers, and for several numbers
/// of rows.
///
/// Below 200 quads, four things change: the axes are divided by the size asked rather than by a size graded
/// away from short sides; parts between other axes are tried as well; holes must find a place in the grid of
/// their part, with lines between them; and if nothing else achieves that, segments may deviate as far as
/// those of a ring. A region whose centre lies on several axes gets numbers that respect all of them, rounded
/// if no grid has such numbers.
///
/// If a straight grid of a region without axes has too many or too few quads, other multiples of the wanted
/// numbers are rounded. Below 200 quads, a grid is then made for each of the four cheapest solutions,
/// including those with fewer soft turns, and the one of best measured quality is used.
///
/// A region of three or five sides that no grid fills gets numbers for three or five grids around one node.
/// The wanted numbers are scaled, because such grids would have too many or too few quads.
///
/// Above `kManyQuads` quads, every other node between corners must be removable, so that `pave()` can coarsen
/// the region. Otherwise segments get twice the numbers of a region half as fine, unless some are given or
/// short.
///
/// The equations of a loop have coefficients of 1 and -1, and a number occurs in two equations only if its
/// segment turns. So the wanted numbers are rounded and then changed by one, the cheapest first, until all
/// equations hold. Holes then get one column more or less if this keeps their centre at its place in the
/// outer loop's grid, which preserves symmetry (below 200 quads both are tried).
/// @param region   with its current nodes; their number does not matter.
/// @param segment  segment of the side from each boundary node to the next.
/// @return  the number of sides of every segment; empty if no grid fits.
/// @throw Cancelled
/// @note  Deterministic. O(nodes · segments).
std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments,
                                               const RunContext& context = {});

} // namespace lacuna::quads
