// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/region.h>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A segment of a region's boundary with a number of sides of its own.
struct BoundarySegment {
    double wanted = 1;  ///< sides by the size asked, not rounded, > 0
    int least = 1;      ///< sides that it needs, >= 1
    bool fixed = false; ///< its number of sides is given
};

/// The even number of sides nearest to those wanted that is no fewer than are needed.
int even_sides(double wanted, int least);

/// More quads than this are made of a quarter as many, and no symmetry is kept (`pave()`): they take long,
/// and nobody looks at them one by one. A choice, not a measurement.
inline constexpr double kManyQuads = 20'000;
/// The fewest sides of a segment that an even number is close to. A choice, not a measurement.
inline constexpr double kFewestEven = 8;

/// Numbers of sides with which `fill_patterns()` fills a region by one grid (interval assignment).
///
/// The whole numbers n of least Σ (n − wanted)² / n for which every loop closes in the grid: as many sides
/// one way as back; about a hole as many on the outer loop as on that hole's. Fixed segments keep theirs. A
/// ring is taken where both its loops so get sides 0.6 to 1.6 times as long as asked, those alike that repeat
/// along a loop where that goes too. Where one side of a ring is narrow, its outer loop has two more for each
/// row that it steps in there. A loop of many corners, alike all round, has a side for each of them, and the
/// other as many, up to four times as many as asked. Otherwise a ring's loops differ by a multiple of four,
/// which rows with two places to change take up. Where none of that goes the lines are straight, and no
/// segment that wants four sides or more gets a quarter more or less.
///
/// A symmetric region, whose mirrorings map segments onto segments, gets numbers that they do not change and
/// that leave a node on every axis they are about: those of its part between two axes, or on one side of the
/// only one, where the axes are segments whose numbers are free. With straight lines the sum has more terms:
/// a quarter of (quads − asked)² / asked, for rows before round turns add quads; for each such turn
/// ln²(rows / those that fit its radius); and what unlike numbers cost where the part is symmetric itself. It
/// is taken at what closes from a few shares of the numbers wanted, and over numbers of rows.
///
/// Of fewer than 200 quads, axes want what the size asked says and not one that changes slowly away from
/// short sides; parts between other axes are looked at too; holes must find a place in the grid of their
/// part, with lines between them; and where nothing else does that, segments get what a ring's may. A region
/// with its middle on several axes gets numbers that all of them keep, rounded where no grid has such.
///
/// Where straight lines of a region without axes are too many or too few quads, other shares of the numbers
/// wanted are rounded. Of fewer than 200 quads a grid is then made with each of the cheapest four numbers,
/// and the best by measure is taken; among them are those of headings with fewer soft turns.
///
/// A region of three or five sides that no grid fills gets numbers for three or five of them round one node,
/// of which it would have too many quads or too few with the numbers wanted.
///
/// Of more than `kManyQuads` quads every other node can be left out between corners: where it could not be,
/// segments get twice the numbers of a region half as fine, unless some are given or short.
///
/// The equations of a loop have coefficients of 1 and -1, and no number is in two but of segments that turn.
/// So the numbers wanted are rounded, and then changed by one, the cheapest first, until all equations hold.
/// Holes then get one column more or less where that puts their middle where it lies in the outer loop's
/// grid, so that what is symmetric stays so (of fewer than 200 quads both are tried); and a ring with like
/// holes about it a number that these divide.
/// @param region   with as many nodes as it would have without.
/// @param segment  of the side from each boundary node to the next.
/// @return  the number of sides of every segment; nothing where no grid fits.
/// @throw Cancelled
/// @note  Deterministic. O(nodes · segments).
std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments,
                                               const RunContext& context = {});

} // namespace lacuna::quads
