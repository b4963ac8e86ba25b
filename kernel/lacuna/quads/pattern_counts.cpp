// SPDX-License-Identifier: MIT
#include <lacuna/quads/pattern_counts.h>

#include <lacuna/quads/detail/pattern_loop.h>
#include <lacuna/quads/detail/pattern_ring.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace lacuna::quads {
namespace {

/// Shares of the sides wanted that a segment may get.
struct Range {
    double least, most;
};
/// What a ring's loops may get, and other segments of four sides or more. With the first, rows of a ring are
/// of the size asked by the measure of `measure_plane()`, edges 0.6 to 1.6 times as long; the second is what
/// is promised for sizes. Shorter segments may change by one side.
constexpr Range kRing{1 / 1.6, 1 / 0.6}, kSegment{1 / 1.25, 1.25};
/// Shares by which rounding may take a ring's segments out of that range, so that loops of several segments
/// still have alike ones: it takes edges along one loop. A choice, not a measurement.
constexpr double kRounding = 1.03;
constexpr Range kRingSegment{kRing.least / kRounding, kRing.most* kRounding};

/// The sides of a segment that run one way.
struct Run {
    std::size_t segment = 0;
    int quarter = 0; ///< 0…3
    double wanted = 0;
    int count = 0;
};

/// Alike for a given ratio, above and below.
double cost_of(const Run& run, int count)
{
    const double off = count - run.wanted;
    return count > 0 ? off * off / count : std::numeric_limits<double>::infinity();
}

/// What a side of a run adds to the excess of sides one way over those back.
std::array<int, 2> step_of(int quarter)
{
    std::array<int, 2> step{};
    step[static_cast<std::size_t>(quarter % 2)] = quarter < 2 ? 1 : -1;
    return step;
}

int badness(const std::array<int, 2>& excess) { return excess[0] * excess[0] + excess[1] * excess[1]; }

/// The runs of one loop, and how far it is from closing.
struct CountedLoop {
    std::vector<Run> runs;
    std::array<int, 2> excess{};
    std::array<int, 2> added{}; ///< sides along headings 0 and 1 that its rows of quads add
    double wanted = 0;          ///< sides in all
};

class CountSolver {
public:
    CountSolver(const PlanarRegion& region, std::span<const int> segment,
                std::span<const BoundarySegment> segments)
        : region_(region), segment_(segment), segments_(segments), own_(segments.size(), 0)
    {
        for (const auto& loop : region.loops) {
            for (const Index p : loop) ++own_[segment_of(p)];
        }
    }

    std::optional<std::vector<int>> run()
    {
        std::size_t about = 0;
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            if (about == 0 || region_.loops[l].size() > region_.loops[about].size()) about = l;
        }
        if (about > 0) {
            if (auto counts = ring_counts(about)) return counts;
        }
        const double angle = main_angle(region_);
        std::vector<CountedLoop> loops;
        for (std::size_t l = 0; l < region_.loops.size(); ++l) {
            auto loop = counted(l, {false, Vec2::Zero(), angle}, kStraightWeight, l == 0 ? 4 : -4);
            if (!loop || !close(*loop, kSegment)) return std::nullopt;
            loops.push_back(std::move(*loop));
        }
        if (loops.size() > 1) centre_holes(loops, angle);
        return counts_of(loops);
    }

private:
    [[nodiscard]] std::size_t segment_of(Index p) const
    {
        return static_cast<std::size_t>(segment_[static_cast<std::size_t>(p)]);
    }

    /// A loop's runs, and its excess once its rows are placed. @return nothing where it fits no grid.
    [[nodiscard]] std::optional<CountedLoop> counted(std::size_t l, const LoopFrame& frame, double weight,
                                                     int turns) const
    {
        auto headed = head_loop(region_.points, region_.loops[l], frame, weight, 1);
        if (!headed) return std::nullopt;
        PatternLoop& loop = *headed;
        if (loop.turns != turns || (frame.polar && !is_ring_loop(region_.points, loop))) return std::nullopt;
        CountedLoop counted;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t s = segment_of(loop.nodes[i]);
            const int quarter = ((loop.heading[i] % 4) + 4) % 4;
            auto run = std::find_if(counted.runs.begin(), counted.runs.end(),
                                    [&](const Run& r) { return r.segment == s && r.quarter == quarter; });
            if (run == counted.runs.end()) run = counted.runs.insert(run, {s, quarter, 0, 0});
            run->wanted += segments_[s].wanted / own_[s];
            ++run->count;
        }
        std::vector<Vec2> points = region_.points;
        std::vector<Quad> quads;
        if (!lay_pattern_rows(loop, points, quads, [](const Vec2&) { return 1.0; })) return std::nullopt;
        for (const int h : loop.heading) {
            const int quarter = ((h % 4) + 4) % 4;
            const auto step = step_of(quarter);
            for (std::size_t k = 0; k < 2; ++k) counted.excess[k] += step[k];
            if (quarter < 2) ++counted.added[static_cast<std::size_t>(quarter)];
        }
        for (const Run& run : counted.runs) {
            if (run.quarter < 2) counted.added[static_cast<std::size_t>(run.quarter)] -= run.count;
        }
        for (Run& run : counted.runs) {
            counted.wanted += run.wanted;
            if (!segments_[run.segment].fixed)
                add(counted, run, std::max(1, static_cast<int>(std::lround(run.wanted))) - run.count);
        }
        // Rounding may have left a segment of several runs with fewer than it needs.
        for (Run& run : counted.runs) {
            const BoundarySegment& own = segments_[run.segment];
            if (!own.fixed && sides_of(counted, run.segment) < own.least) add(counted, run, 1);
        }
        return counted;
    }

    static int sides_of(const CountedLoop& loop, std::size_t segment)
    {
        int sum = 0;
        for (const Run& run : loop.runs) sum += run.segment == segment ? run.count : 0;
        return sum;
    }

    static void add(CountedLoop& loop, Run& run, int by)
    {
        run.count += by;
        const auto step = step_of(run.quarter);
        for (std::size_t k = 0; k < 2; ++k) loop.excess[k] += by * step[k];
    }

    /// Change runs, the cheapest first, until a loop has no excess. @return false where none may change
    [[nodiscard]] bool close(CountedLoop& loop, const Range& range) const
    {
        while (badness(loop.excess) > 0) {
            double least = std::numeric_limits<double>::infinity();
            Run *best = nullptr, *other = nullptr;
            int best_by = 0;
            for (Run& run : loop.runs) {
                for (const int by : {1, -1}) {
                    if (!may_be(loop, run, run.count + by, range)) continue;
                    const double cost = cost_of(run, run.count + by) - cost_of(run, run.count);
                    if (!segments_[run.segment].fixed) {
                        if (!improves(loop, run, by, nullptr) || cost >= least) continue;
                        least = cost;
                        best = &run;
                        other = nullptr;
                        best_by = by;
                        continue;
                    }
                    // A given number of sides that turn: the turn moves.
                    for (Run& next : loop.runs) {
                        if (next.segment != run.segment || &next == &run || next.count - by < 1) continue;
                        const double both = cost + cost_of(next, next.count - by) - cost_of(next, next.count);
                        if (!improves(loop, run, by, &next) || both >= least) continue;
                        least = both;
                        best = &run;
                        other = &next;
                        best_by = by;
                    }
                }
            }
            if (best == nullptr) return false;
            add(loop, *best, best_by);
            if (other != nullptr) add(loop, *other, -best_by);
        }
        return true;
    }

    /// The outer loop with the numbers of sides it has now, in its grid.
    struct OuterGrid {
        std::vector<Vec2> points;
        GridLoop grid;
    };
    [[nodiscard]] std::optional<OuterGrid> outer_grid(const CountedLoop& outer, double angle) const
    {
        const std::vector<Index>& loop = region_.loops[0];
        const auto at = [&](std::size_t i) -> const Vec2& {
            return region_.points[static_cast<std::size_t>(loop[i % loop.size()])];
        };
        OuterGrid made;
        double length = 0;
        for (std::size_t from = 0, to = 0; from < loop.size(); from = to) {
            const std::size_t own = segment_of(loop[from]);
            while (to < loop.size() && segment_of(loop[to]) == own) ++to;
            const int sides = sides_of(outer, own);
            for (int k = 0; k < sides; ++k) {
                const double place = static_cast<double>(k) / sides * static_cast<double>(to - from);
                const auto whole = static_cast<std::size_t>(place);
                const double part = place - static_cast<double>(whole);
                made.points.push_back((1 - part) * at(from + whole) + part * at(from + whole + 1));
            }
            for (std::size_t i = from; i < to; ++i) length += (at(i + 1) - at(i)).norm();
        }
        std::vector<Index> nodes(made.points.size());
        std::iota(nodes.begin(), nodes.end(), 0);
        auto headed = head_loop(made.points, nodes, {false, Vec2::Zero(), angle}, kStraightWeight, 1);
        const double mean = length / static_cast<double>(nodes.size());
        std::vector<Quad> quads;
        if (!headed || !lay_pattern_rows(*headed, made.points, quads, [&](const Vec2&) { return mean; }) ||
            !close_pattern_loop(*headed, 0))
            return std::nullopt;
        made.grid = positions_of(*headed);
        return made;
    }

    /// Give holes an even number of columns where their middle lies on a line of the outer loop's grid, and
    /// an odd one where it lies between two; so for rows. A hole in the middle of a plate then stays there.
    void centre_holes(std::vector<CountedLoop>& loops, double angle) const
    {
        const auto outer = outer_grid(loops[0], angle);
        if (!outer) return;
        for (std::size_t l = 1; l < loops.size(); ++l) {
            const Vec2 middle = mean_value_position(outer->points, outer->grid,
                                                    centre_of(region_.points, region_.loops[l]));
            for (int k = 0; k < 2; ++k) {
                const double off = std::abs(middle[k] - std::round(middle[k]));
                int across = loops[l].added[static_cast<std::size_t>(k)];
                for (const Run& run : loops[l].runs) across += run.quarter == k ? run.count : 0;
                if ((off > 0.25) != (across % 2 != 0)) change_both(loops[l], k);
            }
        }
    }

    /// One more or one less along a heading and back, whichever costs less; nothing where neither may be.
    void change_both(CountedLoop& loop, int quarter) const
    {
        double least = std::numeric_limits<double>::infinity();
        std::array<Run*, 2> best{};
        int best_by = 0;
        for (const int by : {1, -1}) {
            std::array<Run*, 2> cheapest{};
            double sum = 0;
            for (int back = 0; back < 2; ++back) {
                double own = std::numeric_limits<double>::infinity();
                for (Run& run : loop.runs) {
                    if (run.quarter != quarter + 2 * back || segments_[run.segment].fixed ||
                        !may_be(loop, run, run.count + by, kSegment))
                        continue;
                    const double cost = cost_of(run, run.count + by) - cost_of(run, run.count);
                    if (cost >= own) continue;
                    own = cost;
                    cheapest[static_cast<std::size_t>(back)] = &run;
                }
                sum += own;
            }
            if (sum >= least) continue;
            least = sum;
            best = cheapest;
            best_by = by;
        }
        if (best_by == 0) return;
        for (Run* run : best) add(loop, *run, best_by);
    }

    [[nodiscard]] bool may_be(const CountedLoop& loop, const Run& run, int count, const Range& range) const
    {
        const BoundarySegment& own = segments_[run.segment];
        if (count < 1 || own.fixed) return count >= 1;
        const int sides = sides_of(loop, run.segment) + count - run.count;
        if (count < run.count && sides < own.least) return false;
        const double off = sides / own.wanted;
        return (off <= range.most && off >= range.least) || std::abs(sides - own.wanted) <= 1;
    }

    static bool improves(const CountedLoop& loop, const Run& run, int by, const Run* other)
    {
        std::array<int, 2> now = loop.excess;
        for (std::size_t k = 0; k < 2; ++k) {
            now[k] += by * step_of(run.quarter)[k];
            if (other != nullptr) now[k] -= by * step_of(other->quarter)[k];
        }
        return badness(now) < badness(loop.excess);
    }

    /// The sides of a loop that are not of the size asked, each of which costs as much as one too few.
    [[nodiscard]] static double out_of_size(const CountedLoop& loop)
    {
        int sum = 0;
        for (const Run& run : loop.runs) {
            const double off = run.count / run.wanted;
            if (off < kRing.least || off > kRing.most) sum += run.count;
        }
        return sum;
    }

    [[nodiscard]] static double sum_of_costs(const CountedLoop& loop)
    {
        double sum = 0;
        for (const Run& run : loop.runs) sum += cost_of(run, run.count);
        return sum;
    }

    /// Counts for a grid round a hole: the number of sides along it for which the loops' costs, each over
    /// what the loop wants, are least in sum.
    [[nodiscard]] std::optional<std::vector<int>> ring_counts(std::size_t about) const
    {
        std::array<CountedLoop, 2> ends;
        std::array<int, 2> along{};
        std::vector<CountedLoop> others;
        const Vec2 centre = centre_of(region_.points, region_.loops[about]);
        for (std::size_t l = 0; l < region_.loops.size(); ++l) {
            const Vec2 own = centre_of(region_.points, region_.loops[l]);
            const bool is_end = l == 0 || l == about;
            LoopFrame frame{is_end, own, 0};
            if (!is_end) frame.angle = std::atan2(own.y() - centre.y(), own.x() - centre.x());
            auto loop = counted(l, frame,
                                is_end ? kRoundWeight / static_cast<double>(region_.loops[l].size())
                                       : kStraightWeight,
                                is_end ? 0 : -4);
            if (!loop) return std::nullopt;
            if (!is_end) {
                if (!close(*loop, kSegment)) return std::nullopt;
                others.push_back(std::move(*loop));
                continue;
            }
            const std::size_t e = l == 0 ? 0 : 1;
            along[e] = std::abs(loop->excess[0]);
            ends[e] = std::move(*loop);
        }
        const int fold = alike(others, about);
        // Numbers that leave loops as symmetric as they are, where others are as good.
        const int symmetric = std::lcm(fold, std::lcm(repeats(0), repeats(about)));
        std::optional<std::vector<CountedLoop>> best;
        const RingWidths widths = ring_widths(region_.points, region_.loops[0], region_.loops[about]);
        const double size = mean_size(about);
        const int steps = others.empty() ? widths.steps(size) : 0;
        // An even number, where there is one, leaves what lies beyond a loop to quads alone.
        for (const int multiple : {std::lcm(symmetric, 2), std::lcm(fold, 2), fold}) {
            if (!best) best = ring_ends(ends, along, multiple, std::array{2 * steps}, kRingSegment);
        }
        if (!best && others.empty()) {
            // Rows that change their number of sides, alike at two nodes.
            std::vector<int> more;
            for (int rows = 1; rows <= widths.changing(size); ++rows)
                more.push_back(along[0] > along[1] ? 4 * rows : -4 * rows);
            best = ring_ends(ends, along, 2, more, kSegment);
            if (!best) best = ring_ends(ends, along, 2, more, kRingSegment);
        }
        if (!best) return std::nullopt;
        best->insert(best->end(), others.begin(), others.end());
        return counts_of(*best);
    }

    /// The loops of a ring at the least cost in sum, each over what the loop wants.
    /// @param multiple  that the outer loop's number of sides along must be.
    /// @param more      sides more than the inner loop has: the numbers to be tried.
    [[nodiscard]] std::optional<std::vector<CountedLoop>> ring_ends(const std::array<CountedLoop, 2>& ends,
                                                                    const std::array<int, 2>& along,
                                                                    int multiple, std::span<const int> more,
                                                                    const Range& range) const
    {
        std::optional<std::vector<CountedLoop>> best;
        double least = std::numeric_limits<double>::infinity();
        const int low = std::max(3, std::min(along[0], along[1])), high = std::max(along[0], along[1]);
        for (const int by : more) {
            for (int sides = (low + multiple - 1) / multiple * multiple; sides < high + multiple;
                 sides += multiple) {
                if (sides - by < 3) continue;
                double cost = 0;
                bool closed = true;
                std::vector<CountedLoop> tried(ends.begin(), ends.end());
                for (std::size_t e = 0; e < 2 && closed; ++e) {
                    tried[e].excess[0] -= e == 0 ? sides : by - sides;
                    closed = close(tried[e], range);
                    cost += (sum_of_costs(tried[e]) + out_of_size(tried[e])) / tried[e].wanted;
                }
                if (!closed || cost >= least) continue;
                least = cost;
                best = std::move(tried);
            }
        }
        return best;
    }

    /// The mean of the sizes asked along the loops of a ring.
    [[nodiscard]] double mean_size(std::size_t about) const
    {
        double length = 0, wanted = 0;
        for (const std::size_t l : {std::size_t{0}, about}) {
            const std::vector<Index>& loop = region_.loops[l];
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2 &a = region_.points[static_cast<std::size_t>(loop[i])],
                           &b = region_.points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
                length += (b - a).norm();
                wanted += segments_[segment_of(loop[i])].wanted / own_[segment_of(loop[i])];
            }
        }
        return length / wanted;
    }

    /// How often the same segments follow each other on a loop.
    [[nodiscard]] int repeats(std::size_t l) const
    {
        constexpr double kAlike = 0.01; // share by which they may differ; a choice, not a measurement
        std::vector<double> wanted;
        const std::vector<Index>& loop = region_.loops[l];
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::size_t own = segment_of(loop[i]);
            if (i == 0 || own != segment_of(loop[i - 1])) wanted.push_back(segments_[own].wanted);
        }
        const std::size_t n = wanted.size();
        for (std::size_t period = 1; period < n; ++period) {
            if (n % period != 0) continue;
            bool same = true;
            for (std::size_t i = 0; i < n && same; ++i)
                same = std::abs(wanted[i] - wanted[i % period]) <= kAlike * wanted[i];
            if (same) return static_cast<int>(n / period);
        }
        return 1;
    }

    /// How many holes there are beside the one the grid goes round, where they are of one size and at one
    /// distance from it; else 1. A number of sides that they divide leaves them alike.
    [[nodiscard]] int alike(const std::vector<CountedLoop>& others, std::size_t about) const
    {
        constexpr double kAlike = 0.01; // share by which they may differ; a choice, not a measurement
        const Vec2 centre = centre_of(region_.points, region_.loops[about]);
        double first = 0;
        for (std::size_t l = 1; l < region_.loops.size(); ++l) {
            if (l == about) continue;
            const double distance = (centre_of(region_.points, region_.loops[l]) - centre).norm();
            if (first == 0) first = distance;
            if (std::abs(distance - first) > kAlike * first) return 1;
        }
        const bool same = std::all_of(others.begin(), others.end(), [&](const CountedLoop& loop) {
            return std::abs(loop.wanted - others.front().wanted) <= kAlike * others.front().wanted;
        });
        return same && !others.empty() ? static_cast<int>(others.size()) : 1;
    }

    [[nodiscard]] std::optional<std::vector<int>> counts_of(const std::vector<CountedLoop>& loops) const
    {
        std::vector<int> counts(segments_.size(), 0);
        for (const CountedLoop& loop : loops) {
            for (const Run& run : loop.runs) counts[run.segment] += run.count;
        }
        return counts;
    }

    const PlanarRegion& region_;
    std::span<const int> segment_;
    std::span<const BoundarySegment> segments_;
    std::vector<int> own_; ///< sides that each segment has in the region
};

} // namespace

std::optional<std::vector<int>> pattern_counts(const PlanarRegion& region, std::span<const int> segment,
                                               std::span<const BoundarySegment> segments)
{
    return CountSolver(region, segment, segments).run();
}

} // namespace lacuna::quads
