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

/// Above this number of quads, `pave()` first paves with a quarter as many quads and refines this mesh, and
/// does not make the mesh symmetric. Both limit the time.
inline constexpr double kManyQuads = 20'000;
/// With fewer quads than this, numbers of sides are chosen with more care, which takes little time. Grids are
/// made for several solutions. The axes of a part are divided by the requested size first, because the graded
/// size, which grows away from short given sides, would leave too few grid lines in the part.
inline constexpr double kFewQuads = 200;
/// Number of candidates that are tried, in the order of their estimated cost.
inline constexpr std::size_t kCandidates = 4;

/// Numbers of sides with which `fill_patterns()` fills a region by one grid (interval assignment).
///
/// The function minimises Σ (n − wanted)² / n over integers n, the numbers of sides of the segments. Every
/// loop must close in the grid: it has as many sides in each direction as in the opposite direction. Fixed
/// segments keep their numbers. Segments that repeat along a loop get equal numbers if possible. Grids are
/// tried in this order:
///
/// 1. A ring grid around a hole, whose outer loop and hole have equal numbers of sides. It is used if the
///    sides of both loops are then 0.6 to 1.6 times as long as requested. A ring that is narrow on one side
///    gets fewer rows there. For each row less, the outer loop has two sides more than the hole.
/// 2. If a loop repeats the same segments: a ring grid with one side of the outer loop from each corner to
///    the next. The hole has as many sides, up to four times its requested number.
/// 3. A ring grid whose loops differ by a multiple of four sides. Rows that change their number of quads at
///    two places take up the difference.
/// 4. A straight grid. A segment with four or more wanted sides is changed by less than a quarter.
///
/// If reflections of a symmetric region map segments onto segments, the numbers are symmetric under these
/// reflections, and every mirror axis passes through nodes. The numbers are computed for the part between two
/// axes, or on one side of a single axis; the axes are free segments of this part. If the centre of the
/// region lies on several axes, the numbers are symmetric under all of them; if no grid has such numbers, the
/// wanted numbers are rounded.
///
/// For a straight grid the sum has three more terms:
/// - a quarter of (quads − requested)² / requested, because rows along round turns add quads. A round (soft)
///   turn is one where the grid turns behind some rows of quads, see `PatternLoop`;
/// - for each round turn, ln²(rows / fitting rows), times half the number of fitting rows if there are more
///   than two. The fitting rows fill about a third of the radius of the widest turn (`fitting_rows()`);
/// - a penalty for unequal numbers of mirrored segments if the part itself is symmetric.
///
/// The sum is compared for several solutions: rounding starts from several multiples of the wanted numbers,
/// and several numbers of rows are tried. If the straight grid of a region without axes then has too many or
/// too few quads, further multiples are tried.
///
/// Below 200 quads, there are these differences:
/// - The axes are divided by the requested size, not by a size that grows away from short sides.
/// - Parts between other pairs of axes are tried as well.
/// - The grid of a part must have grid lines between its holes. If there is no such grid, segments may
///   deviate from their wanted numbers as much as on a ring.
/// - For a straight grid of a region without axes, a grid is made for each of the four cheapest solutions,
///   including those with fewer round turns. The numbers of the grid with the best measured quality are used.
///
/// A region of three or five sides that no grid fills gets numbers for three or five grids around one node.
/// The wanted numbers are scaled, because such grids would otherwise have too many or too few quads.
///
/// Above `kManyQuads` quads, `pave()` must be able to coarsen the region: to remove every other node between
/// corners. If the numbers found do not permit this, segments get twice the numbers that they would get with
/// twice the size, unless some numbers are fixed or some segments are short.
///
/// Method: the equations of a loop have coefficients of 1 and -1, and a number occurs in two equations only
/// if its segment turns. Therefore it is enough to round the wanted numbers and to change numbers by one, the
/// cheapest change first, until all equations hold. Afterwards a hole gets one row or column more or less if
/// its centre then lies where the outer loop's grid coordinates require it, which preserves symmetry. Below
/// 200 quads, the numbers without this change are tried too.
/// @param region   the region with its current nodes, whose number does not matter.
/// @param segment  for each boundary node, the number of the segment that contains the side from this node to
///         the next.
/// @return  the number of sides of every segment; empty if no grid fits.
/// @throw Cancelled
/// @note  Deterministic. O(nodes · segments).
std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments,
                                               const RunContext& context = {});

} // namespace lacuna::quads
