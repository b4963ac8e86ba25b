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

/// Additional cost if the number of quads differs from the wanted number by more than a quarter. It exceeds
/// the cost of any numbers of sides within their range.
constexpr double kOffAsked = 1e6;

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
std::optional<Counts> best_near(const CountTask& task, const std::vector<std::size_t>& sides,
                                const std::vector<double>& feet, const CountRange& range)
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
            if (!is_allowed || !are_alike(counts.sides, pairs)) continue;
            counts.cost += kWeightOfQuads * (quads - asked) * (quads - asked) / asked;
            if (std::abs(quads - asked) > kQuadsOff * asked) counts.cost += kOffAsked;
            if (counts.cost < (best ? best->cost : kInfinity)) best = std::move(counts);
        }
    }
    return best;
}

} // namespace

std::optional<std::vector<int>> star_counts(const CountTask& task)
{
    // Minimum ratio between the smallest and the largest width of a grid. Not measured.
    constexpr double kBalanced = 0.5;
    const std::vector<std::size_t> sides = sides_of_patch(task);
    if (sides.size() != 3 && sides.size() != 5) return std::nullopt;
    const std::vector<double> feet = wanted_feet(task, sides);
    if (std::ranges::min(feet) < kBalanced * std::ranges::max(feet)) return std::nullopt;
    std::optional<Counts> best;
    for (const CountRange& range : {kSegment, kRingSegment}) {
        auto found = best_near(task, sides, feet, range);
        if (found && (!best || found->cost < best->cost)) best = std::move(found);
        if (best && best->cost < kOffAsked) break;
    }
    if (!best) return std::nullopt;
    return std::move(best->sides);
}

} // namespace lacuna::quads
