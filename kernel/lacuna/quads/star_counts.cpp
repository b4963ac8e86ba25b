// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/star_counts.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/segment_symmetry.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quads {
namespace {

/// The segments that are the sides of a patch, between its corners. Empty if a side bends or consists of
/// several segments.
std::vector<std::size_t> sides_of_patch(const CountTask& task)
{
    if (task.region.loops.size() != 1) return {};
    const std::vector<Index>& loop = task.region.loops[0];
    const std::size_t n = loop.size();
    std::vector<std::size_t> sides;
    for (std::size_t i = 0; i < n; ++i) {
        const bool starts = task.segment_of(loop[i]) != task.segment_of(loop[(i + n - 1) % n]);
        if (quads_in(corner_angle(task.region.points, loop, i)) != (starts ? 1 : 2)) return {};
        if (starts) sides.push_back(task.segment_of(loop[i]));
    }
    return sides;
}

/// For each grid, its wanted foot, see `spoke_feet()`: the number of the grid's edges along the side that
/// starts at the grid's corner. Side i has foot[i] + foot[i + 2] edges.
std::vector<double> wanted_feet(const CountTask& task, const std::vector<std::size_t>& sides)
{
    const std::size_t n = sides.size();
    std::vector<double> feet(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < n; ++k)
            feet[i] += (k % 2 == 0 ? 0.5 : -0.5) * task.segments[sides[(i + 2 * k) % n]].wanted;
    }
    return feet;
}

/// The best numbers of sides whose feet are near several multiples of the wanted feet. Empty if none are
/// permitted.
/// @param most_off  largest deviation from the requested number of quads, as a share of it.
std::optional<Counts> best_near(const CountTask& task, const std::vector<std::size_t>& sides,
                                const std::vector<double>& feet, const CountRange& range, double most_off)
{
    constexpr std::array<double, 11> kShares{1, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 1.05, 1.1, 1.15, 1.2};
    const std::vector<SegmentPair> pairs = mirrored_segments(task.region, task.segment);
    const double asked = quads_asked(task);
    const std::size_t n = sides.size();
    std::optional<Counts> best;
    std::size_t choices = 1;
    for (std::size_t k = 0; k < n; ++k) choices *= 3;
    for (const double share : kShares) {
        for (std::size_t choice = 0; choice < choices; ++choice) {
            std::vector<int> foot;
            std::size_t left = choice;
            for (const double wanted : feet) {
                foot.push_back(std::max(1, static_cast<int>(std::lround(share * wanted)) +
                                               static_cast<int>(left % 3) - 1));
                left /= 3;
            }
            Counts counts{std::vector<int>(task.segments.size()), 0};
            double quads = 0;
            bool is_allowed = true;
            for (std::size_t i = 0; i < n; ++i) {
                const BoundarySegment& own = task.segments[sides[i]];
                const int count = foot[i] + foot[(i + 2) % n];
                is_allowed = is_allowed &&
                             (own.fixed ? count == task.own[sides[i]]
                                        : count >= own.least && is_within(range, own.wanted, count));
                counts.sides[sides[i]] = count;
                counts.cost += cost_of_sides(own.wanted, count);
                quads += foot[i] * foot[(i + 1) % n];
            }
            is_allowed = is_allowed && std::abs(quads - asked) <= most_off * asked;
            if (!is_allowed || !are_alike(counts.sides, pairs)) continue;
            counts.cost += kWeightOfQuads * (quads - asked) * (quads - asked) / asked;
            if (counts.cost < (best ? best->cost : kInfinity)) best = std::move(counts);
        }
    }
    return best;
}

} // namespace

std::optional<std::vector<int>> star_counts(const CountTask& task)
{
    const std::vector<std::size_t> sides = sides_of_patch(task);
    if (sides.size() != 3 && sides.size() != 5) return std::nullopt;
    const std::vector<double> feet = wanted_feet(task, sides);
    // The widths of the grids may differ as much as the accepted lengths of sides.
    if (kLongestOfSize * std::ranges::min(feet) < kShortestOfSize * std::ranges::max(feet))
        return std::nullopt;
    auto found = best_near(task, sides, feet, kSegment, kQuadsOff);
    if (!found) found = best_near(task, sides, feet, kRingSegment, kQuadsOff);
    if (!found) found = best_near(task, sides, feet, kRingSegment, kInfinity);
    if (!found) return std::nullopt;
    return std::move(found->sides);
}

} // namespace lacuna::quads
