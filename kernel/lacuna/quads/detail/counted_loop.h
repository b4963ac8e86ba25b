// SPDX-License-Identifier: MIT
#pragma once

/// Numbers of sides for the segments of a loop with which the loop closes in a grid. Only sources of this
/// folder include it.

#include <lacuna/quads/detail/pattern_loop.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// The input for finding numbers of sides, as for `pattern_counts()`.
struct CountTask {
    CountTask(const PlanarRegion& region, std::span<const int> segment,
              std::span<const BoundarySegment> segments, const RunContext& context);

    const PlanarRegion& region;
    std::span<const int> segment;
    std::span<const BoundarySegment> segments;
    const RunContext& context;
    std::vector<int> own; ///< current number of sides of each segment

    [[nodiscard]] std::size_t segment_of(Index p) const { return index(segment[index(p)]); }
};

/// Mean of the target size along the boundary [model length].
double mean_size(const CountTask& task);

/// Number of quads that the size requires. It follows from the region's size or, if the region has none, from
/// the wanted numbers of sides.
double quads_asked(const CountTask& task);

/// Range for the number of sides of a segment, relative to the wanted number.
struct CountRange {
    double least, most;
};
/// kRing applies to the loops of a ring: edges may be 0.6 to 1.6 times as long as wanted, which is the range
/// that `measure_plane()` accepts. kSegment applies to other segments with four or more sides, and is the
/// range that `pattern_counts()` promises. Segments with fewer sides may change by one side.
inline constexpr CountRange kRing{1 / kLongestOfSize, 1 / kShortestOfSize}, kSegment{1 / 1.25, 1.25};
/// The range kRing is widened by this factor for single segments (`kRingSegment`). Segments that repeat along
/// a loop then get equal numbers of sides, although each number is rounded. A larger factor preserves more
/// symmetry, but lets edges deviate more from their size.
inline constexpr double kRingRounding = 1.03;
inline constexpr CountRange kRingSegment{kRing.least / kRingRounding, kRing.most* kRingRounding};

/// Weight of the deviation of the number of quads from the requested number, against the costs of the numbers
/// of sides. Chosen on 40 outlines of the family that `--held` draws (benchmarks/pave/).
inline constexpr double kWeightOfQuads = 0.25;

/// Whether a number of sides is within a range of the wanted number, or differs from it by one.
bool is_within(const CountRange& range, double wanted, int sides);

/// (n − wanted)² / n, with n = `sides`. A number of sides that is too large by some factor costs as much as a
/// number that is too small by this factor. Infinite for n = 0.
double cost_of_sides(double wanted, int sides);

/// Numbers of sides of every segment, and a cost by which the numbers for different parts of a region are
/// compared.
struct Counts {
    std::vector<int> sides;
    double cost = 0;
};

/// Run: consecutive sides of a segment that have the same heading in the grid.
struct CountedRun {
    std::size_t segment = 0;
    int quarter = 0; ///< heading in quarter turns, 0…3
    double wanted = 0;
    int count = 0;
};

/// The runs of one loop, and the loop's excess of sides, which is zero if the loop closes in the grid.
struct CountedLoop {
    std::vector<CountedRun> runs;
    /// For headings 0 and 1: the number of sides along the heading minus the number in the opposite
    /// direction.
    std::array<int, 2> excess{};
    std::array<int, 2> added{}; ///< numbers of sides that the loop's rows of quads add along headings 0 and 1
    double wanted = 0;          ///< total number of wanted sides
    int soft = 0;               ///< number of soft turns of the loop, see `PatternLoop`
};

/// The runs of a loop with their wanted numbers of sides, rounded, and the excess of the loop after its rows
/// are placed.
/// @param share  factor on the wanted numbers.
/// @return  empty if the loop fits no grid.
std::optional<CountedLoop> counted_loop(const CountTask& task, PatternLoop loop, double share = 1);

/// Change the numbers of sides of runs by one, the cheapest change first, until a loop has no excess.
/// @return  false if a loop still has an excess but no further change is allowed
/// @throw Cancelled
bool close_counts(const CountTask& task, CountedLoop& loop, const CountRange& range);

/// Add one side along a heading and one side in the opposite direction, or remove one of each, whichever
/// costs less. Do nothing if neither is allowed.
/// @param quarter  0 or 1
void change_both(const CountTask& task, CountedLoop& loop, int quarter);

/// Σ `cost_of_sides()` over the runs.
double sum_of_costs(const CountedLoop& loop);

/// Number of sides of a segment along a loop.
int sides_of(const CountedLoop& loop, std::size_t segment);

/// Number of sides of every segment on the given loops.
std::vector<int> counts_of(const CountTask& task, const std::vector<CountedLoop>& loops);

/// The points of a loop after dividing each of its segments into its number of sides.
std::vector<Vec2> divided_loop(const CountTask& task, const Cycle& loop, std::span<const int> counts);

} // namespace lacuna::quads
