// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/star_counts.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/detail/segment_symmetry.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quads {
namespace {

/// Cost of numbers that are not allowed, and of numbers that miss the promised number of quads (within a
/// quarter). The latter exceeds any cost of sides within their range.
constexpr double kOffAsked = 1e6;

/// The segments between the corners of a patch; empty if a side bends or is not one segment.
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

/// Whether no grid of the patch would be much narrower than another if the sides had the wanted numbers.
bool is_balanced(const CountTask& task, const std::vector<std::size_t>& sides)
{
    constexpr double kBalanced = 0.5; // least width of a grid relative to the widest. Not measured
    const std::size_t n = sides.size();
    double least = kInfinity, most = 0;
    for (std::size_t i = 0; i < n; ++i) {
        // Side i is foot[i] + foot[i + 2] long.
        double foot = 0;
        for (std::size_t k = 0; k < n; ++k)
            foot += (k % 2 == 0 ? 0.5 : -0.5) * task.segments[sides[(i + 2 * k) % n]].wanted;
        least = std::min(least, foot);
        most = std::max(most, foot);
    }
    return least >= kBalanced * most;
}

/// Cost of numbers of sides; `kInfinity` if a segment is outside a range.
class StarCost {
public:
    StarCost(const CountTask& task, std::vector<std::size_t> sides)
        : task_(task),
          sides_(std::move(sides)),
          pairs_(mirrored_segments(task.region, task.segment)),
          asked_(quads_asked(task))
    {
    }

    [[nodiscard]] double operator()(const std::vector<int>& counts, const CountRange& range) const
    {
        constexpr double kQuads = 0.25; // weight of the number of quads, as in `straight_counts()`
        double cost = 0;
        SideCounts side;
        for (const std::size_t s : sides_) {
            const BoundarySegment& own = task_.segments[s];
            if (!own.fixed && (counts[s] < own.least || !is_within(range, own.wanted, counts[s])))
                return kInfinity;
            cost += cost_of_sides(own.wanted, counts[s]);
            side.side[side.count++] = counts[s];
        }
        std::array<int, kMostSides> foot{};
        if (!are_alike(counts, pairs_) || !spoke_feet(side, false, foot)) return kInfinity;
        double quads = 0;
        for (std::size_t i = 0; i < side.count; ++i) quads += foot[i] * foot[(i + 1) % side.count];
        cost += kQuads * (quads - asked_) * (quads - asked_) / asked_;
        return cost + (std::abs(quads - asked_) > asked_ / 4 ? kOffAsked : 0);
    }

private:
    const CountTask& task_;
    std::vector<std::size_t> sides_;
    std::vector<SegmentPair> pairs_;
    double asked_;
};

/// The best numbers near several multiples of the wanted ones; empty if none are allowed.
std::optional<Counts> best_near(const CountTask& task, const std::vector<std::size_t>& sides,
                                const StarCost& cost_of, const CountRange& range)
{
    constexpr std::array<double, 11> kShares{1, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 1.05, 1.1, 1.15, 1.2};
    std::optional<Counts> best;
    std::size_t choices = 1;
    for (std::size_t k = 0; k < sides.size(); ++k) choices *= 3;
    for (const double share : kShares) {
        for (std::size_t choice = 0; choice < choices; ++choice) {
            Counts counts{std::vector<int>(task.segments.size()), 0};
            std::size_t left = choice;
            for (const std::size_t s : sides) {
                const BoundarySegment& own = task.segments[s];
                const int near = static_cast<int>(std::lround(share * own.wanted)),
                          by = static_cast<int>(left % 3) - 1;
                left /= 3;
                counts.sides[s] = own.fixed ? task.own[s] : std::max(own.least, near + by);
            }
            counts.cost = cost_of(counts.sides, range);
            if (counts.cost < (best ? best->cost : kInfinity)) best = std::move(counts);
        }
    }
    return best;
}

} // namespace

std::optional<std::vector<int>> star_counts(const CountTask& task)
{
    const std::vector<std::size_t> sides = sides_of_patch(task);
    if ((sides.size() != 3 && sides.size() != 5) || !is_balanced(task, sides)) return std::nullopt;
    const StarCost cost_of(task, sides);
    std::optional<Counts> best;
    for (const CountRange& range : {kSegment, kRingSegment}) {
        auto found = best_near(task, sides, cost_of, range);
        if (found && (!best || found->cost < best->cost)) best = std::move(found);
        if (best && best->cost < kOffAsked) break;
    }
    if (!best) return std::nullopt;
    return std::move(best->sides);
}

} // namespace lacuna::quads
