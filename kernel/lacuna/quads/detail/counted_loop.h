// SPDX-License-Identifier: MIT
#pragma once

/// Loops whose segments get numbers of sides with which they close in a grid. Only sources of this folder
/// include it.

#include <lacuna/quads/detail/pattern_loop.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace lacuna::quads {

/// What numbers of sides are found for: as for `pattern_counts()`.
struct CountTask {
    CountTask(const PlanarRegion& region, std::span<const int> segment,
              std::span<const BoundarySegment> segments, const RunContext& context);

    const PlanarRegion& region;
    std::span<const int> segment;
    std::span<const BoundarySegment> segments;
    const RunContext& context;
    std::vector<int> own; ///< sides that each segment has in the region

    [[nodiscard]] std::size_t segment_of(Index p) const { return index(segment[index(p)]); }
};

/// The mean of the sizes asked along the boundary [model length].
double mean_size(const CountTask& task);

/// Quads that the size asks for: that of the region where it has one, else of the sides wanted.
double quads_asked(const CountTask& task);

/// Shares of the sides wanted that a segment may get.
struct CountRange {
    double least, most;
};
/// What a ring's loops may get, and other segments of four sides or more. With the first, rows of a ring are
/// of the size asked by the measure of `measure_plane()`, edges 0.6 to 1.6 times as long; the second is what
/// is promised for sizes. Shorter segments may change by one side.
inline constexpr CountRange kRing{1 / 1.6, 1 / 0.6}, kSegment{1 / 1.25, 1.25};
/// Shares by which rounding may take a ring's segments out of that range, so that loops of several segments
/// still have alike ones: it takes edges along one loop. A choice, not a measurement.
inline constexpr double kRingRounding = 1.03;
inline constexpr CountRange kRingSegment{kRing.least / kRingRounding, kRing.most* kRingRounding};

/// Whether a number of sides is within a range of those wanted, or one off.
bool is_within(const CountRange& range, double wanted, int sides);

/// (n − wanted)² / n: alike for a given ratio, above and below; infinite for none.
double cost_of_sides(double wanted, int sides);

/// Numbers of sides of every segment, and what they cost beside those of other parts of a region.
struct Counts {
    std::vector<int> sides;
    double cost = 0;
};

/// The sides of a segment that run one way.
struct CountedRun {
    std::size_t segment = 0;
    int quarter = 0; ///< 0…3
    double wanted = 0;
    int count = 0;
};

/// The runs of one loop, and how far it is from closing.
struct CountedLoop {
    std::vector<CountedRun> runs;
    std::array<int, 2> excess{}; ///< sides one way over those back
    std::array<int, 2> added{};  ///< sides along headings 0 and 1 that its rows of quads add
    double wanted = 0;           ///< sides in all
    int soft = 0;                ///< turns that its rows of quads make
};

/// A loop's runs with the numbers wanted, rounded, and its excess once its rows are placed.
/// @param share  of the sides wanted.
/// @return  nothing where it fits no grid.
std::optional<CountedLoop> counted_loop(const CountTask& task, PatternLoop loop, double share = 1);

/// Change runs, the cheapest first, until a loop has no excess. @return false where none may change
/// @throw Cancelled
bool close_counts(const CountTask& task, CountedLoop& loop, const CountRange& range);

/// One side more or one less along a heading and back, whichever costs less; nothing where neither may be.
/// @param quarter  0 or 1
void change_both(const CountTask& task, CountedLoop& loop, int quarter);

/// Σ `cost_of_sides()` over the runs.
double sum_of_costs(const CountedLoop& loop);

/// Sides of a segment along a loop.
int sides_of(const CountedLoop& loop, std::size_t segment);

/// The sides of every segment on some loops.
std::vector<int> counts_of(const CountTask& task, const std::vector<CountedLoop>& loops);

} // namespace lacuna::quads
