// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/pattern_counts.h>

#include <lacuna/quads/detail/coarse_region.h>
#include <lacuna/quads/detail/mirror_counts.h>
#include <lacuna/quads/detail/ring_counts.h>
#include <lacuna/quads/detail/segment_symmetry.h>
#include <lacuna/quads/detail/star_counts.h>
#include <lacuna/quads/detail/straight_counts.h>

#include <cmath>
#include <optional>

namespace lacuna::quads {

namespace {

std::optional<std::vector<int>> counts_for(const CountTask& task)
{
    const PlanarRegion& region = task.region;
    auto ring = ring_counts(task);
    if (ring && are_alike(*ring, mirrored_segments(region, task.segment))) return ring;
    auto mirrored = mirror_counts(task);
    if (mirrored && std::isfinite(mirrored->cost)) return std::move(mirrored->sides);
    if (auto star = star_counts(task)) return star;
    if (mirrored) return std::move(mirrored->sides);
    if (ring) return ring;
    auto counts = straight_counts(task);
    if (!counts) return std::nullopt;
    return std::move(counts->sides);
}

/// Whether every other node of each loop can be left out without leaving out a corner.
bool can_be_halved(const CountTask& task, const std::vector<int>& counts)
{
    for (const std::vector<Index>& loop : task.region.loops) {
        int nodes = 0; // up to the present node
        std::optional<int> first;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t own = task.segment_of(loop[i]);
            if (i > 0 && own == task.segment_of(loop[i - 1])) continue;
            if (paving::stays(task.region, loop, i)) {
                if ((nodes - first.value_or(nodes)) % 2 != 0) return false;
                first = nodes;
            }
            nodes += counts[own];
        }
        if (nodes % 2 != 0) return false;
    }
    return true;
}

/// Twice the numbers of sides of a region with twice the size. @return empty if some numbers are given
std::optional<std::vector<int>> even_counts(const CountTask& task)
{
    std::vector<BoundarySegment> segments(task.segments.begin(), task.segments.end());
    for (BoundarySegment& own : segments) {
        if (own.fixed) return std::nullopt;
        own = {own.wanted / 2, (own.least + 1) / 2};
    }
    auto counts = counts_for(CountTask(task.region, task.segment, segments, task.context));
    if (!counts) return std::nullopt;
    for (int& count : *counts) count *= 2;
    return counts;
}

} // namespace

int even_sides(double wanted, int least)
{
    return std::max(2 * ((least + 1) / 2), 2 * static_cast<int>(std::lround(wanted / 2)));
}

std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments,
                                               const RunContext& context)
{
    const CountTask task(region, segment, segments, context);
    auto counts = counts_for(task);
    if (counts && quads_asked(task) > kManyQuads && !can_be_halved(task, *counts)) {
        if (auto even = even_counts(task)) return even;
    }
    return counts;
}

} // namespace lacuna::quads
