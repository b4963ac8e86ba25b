// SPDX-License-Identifier: MIT
#include <lacuna/core/shared/constants.h>
#include <lacuna/quads/detail/counted_loop.h>

#include <algorithm>
#include <cmath>

namespace lacuna::quads {
namespace {

double cost_of(const CountedRun& run, int count) { return cost_of_sides(run.wanted, count); }

void add(CountedLoop& loop, CountedRun& run, int by)
{
    run.count += by;
    advance(loop.excess, run.quarter, by);
}

/// Whether a run may be changed to `count` sides. Its segment has `now` sides in total before the change.
bool may_be(const CountTask& task, int now, const CountedRun& run, int count, const CountRange& range)
{
    const BoundarySegment& own = task.segments[run.segment];
    if (count < 1 || own.fixed) return count >= 1;
    const int sides = now + count - run.count;
    return (count >= run.count || sides >= own.least) && is_within(range, own.wanted, sides);
}

bool improves(const CountedLoop& loop, const CountedRun& run, int by, const CountedRun* other)
{
    std::array<int, 2> now = loop.excess;
    advance(now, run.quarter, by);
    if (other != nullptr) advance(now, other->quarter, -by);
    return badness(now) < badness(loop.excess);
}

/// The runs of a loop: its segments divided where the heading changes.
std::vector<CountedRun> runs_of(const CountTask& task, const PatternLoop& loop, double share)
{
    std::vector<CountedRun> runs;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const std::size_t s = task.segment_of(loop.nodes[i]);
        const int quarter = quarter_of(loop.heading[i]);
        auto run = std::ranges::find_if(
            runs, [&](const CountedRun& r) { return r.segment == s && r.quarter == quarter; });
        if (run == runs.end()) run = runs.insert(run, {s, quarter, 0, 0});
        run->wanted += share * task.segments[s].wanted / task.own[s];
        ++run->count;
    }
    return runs;
}

} // namespace

bool is_within(const CountRange& range, double wanted, int sides)
{
    const double share = sides / wanted;
    return (share >= range.least && share <= range.most) || std::abs(sides - wanted) <= 1;
}

double cost_of_sides(double wanted, int sides)
{
    const double off = sides - wanted;
    return sides > 0 ? off * off / sides : kInfinity;
}

CountTask::CountTask(const PlanarRegion& of, std::span<const int> segment_of_side,
                     std::span<const BoundarySegment> all, const RunContext& run)
    : region(of), segment(segment_of_side), segments(all), context(run), own(all.size(), 0)
{
    for (const auto& loop : region.loops) {
        for (const Index p : loop) ++own[segment_of(p)];
    }
}

double mean_size(const CountTask& task)
{
    double length = 0, wanted = 0;
    for (const auto& loop : task.region.loops) {
        for (const Index p : loop)
            wanted += task.segments[task.segment_of(p)].wanted / task.own[task.segment_of(p)];
    }
    for_boundary_sides(task.region, [&](const Vec2& a, const Vec2& b) { length += (b - a).norm(); });
    return length / wanted;
}

double quads_asked(const CountTask& task)
{
    const PlanarRegion& region = task.region;
    double area = 0, density = 0;
    for (const auto& loop : region.loops) area += twice_area(region.points, loop) / 2;
    if (!region.size) {
        const double size = mean_size(task);
        return area / (size * size);
    }
    for (const Vec2& p : region.points)
        density += 1 / (region.size(p) * region.size(p)) / static_cast<double>(region.points.size());
    return area * density;
}

std::optional<CountedLoop> counted_loop(const CountTask& task, PatternLoop loop, double share)
{
    CountedLoop counted;
    counted.runs = runs_of(task, loop, share);
    counted.soft = static_cast<int>(std::ranges::count(loop.movable, 1));
    std::vector<Vec2> points = task.region.points;
    std::vector<Quad> quads;
    if (!lay_pattern_rows(loop, points, quads, [](const Vec2&) { return 1.0; })) return std::nullopt;
    for (const int h : loop.heading) {
        const int quarter = quarter_of(h);
        advance(counted.excess, quarter);
        if (quarter < 2) ++counted.added[index(quarter)];
    }
    for (const CountedRun& run : counted.runs) {
        if (run.quarter < 2) counted.added[index(run.quarter)] -= run.count;
    }
    for (CountedRun& run : counted.runs) {
        counted.wanted += run.wanted;
        if (!task.segments[run.segment].fixed)
            add(counted, run, std::max(1, static_cast<int>(std::lround(run.wanted))) - run.count);
    }
    // Because each run is rounded separately, a segment with several runs may have fewer sides than its
    // minimum.
    for (CountedRun& run : counted.runs) {
        const BoundarySegment& own = task.segments[run.segment];
        if (!own.fixed && sides_of(counted, run.segment) < own.least) add(counted, run, 1);
    }
    return counted;
}

bool close_counts(const CountTask& task, CountedLoop& loop, const CountRange& range)
{
    // For each segment: number of its runs, and of its sides.
    std::vector<int> runs(task.segments.size(), 0), sides(task.segments.size(), 0);
    for (const CountedRun& run : loop.runs) {
        ++runs[run.segment];
        sides[run.segment] += run.count;
    }
    const auto change = [&](CountedRun& run, int by) {
        add(loop, run, by);
        sides[run.segment] += by;
    };
    while (badness(loop.excess) > 0) {
        check_cancelled(task.context);
        double least = kInfinity;
        CountedRun *best = nullptr, *other = nullptr;
        int best_by = 0;
        for (CountedRun& run : loop.runs) {
            // If the number of sides of a segment is given and the segment has a single run, it contains no
            // turn that could be moved.
            if (task.segments[run.segment].fixed && runs[run.segment] == 1) continue;
            for (const int by : {1, -1}) {
                if (!may_be(task, sides[run.segment], run, run.count + by, range)) continue;
                const double cost = cost_of(run, run.count + by) - cost_of(run, run.count);
                if (!task.segments[run.segment].fixed) {
                    if (!improves(loop, run, by, nullptr) || cost >= least) continue;
                    least = cost;
                    best = &run;
                    other = nullptr;
                    best_by = by;
                    continue;
                }
                // If the number of sides of the segment is given, another run of the segment changes by the
                // opposite amount: the turn between the two runs moves.
                for (CountedRun& next : loop.runs) {
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
        change(*best, best_by);
        if (other != nullptr) change(*other, -best_by);
    }
    return true;
}

void change_both(const CountTask& task, CountedLoop& loop, int quarter)
{
    double least = kInfinity;
    std::array<CountedRun*, 2> best{};
    int best_by = 0;
    for (const int by : {1, -1}) {
        std::array<CountedRun*, 2> cheapest{};
        double sum = 0;
        for (int back = 0; back < 2; ++back) {
            double own = kInfinity;
            for (CountedRun& run : loop.runs) {
                if (run.quarter != quarter + 2 * back || task.segments[run.segment].fixed ||
                    !may_be(task, sides_of(loop, run.segment), run, run.count + by, kSegment))
                    continue;
                const double cost = cost_of(run, run.count + by) - cost_of(run, run.count);
                if (cost >= own) continue;
                own = cost;
                cheapest[index(back)] = &run;
            }
            sum += own;
        }
        if (sum >= least) continue;
        least = sum;
        best = cheapest;
        best_by = by;
    }
    if (best_by == 0) return;
    for (CountedRun* run : best) add(loop, *run, best_by);
}

double sum_of_costs(const CountedLoop& loop)
{
    double sum = 0;
    for (const CountedRun& run : loop.runs) sum += cost_of(run, run.count);
    return sum;
}

int sides_of(const CountedLoop& loop, std::size_t segment)
{
    int sum = 0;
    for (const CountedRun& run : loop.runs) sum += run.segment == segment ? run.count : 0;
    return sum;
}

std::vector<int> counts_of(const CountTask& task, const std::vector<CountedLoop>& loops)
{
    std::vector<int> counts(task.segments.size(), 0);
    for (const CountedLoop& loop : loops) {
        for (const CountedRun& run : loop.runs) counts[run.segment] += run.count;
    }
    return counts;
}

std::vector<Vec2> divided_loop(const CountTask& task, const Cycle& loop, std::span<const int> counts)
{
    const std::size_t n = loop.size();
    const auto own = [&](std::size_t i) { return task.segment_of(loop[i % n]); };
    // Start at the first node of a segment. If the whole loop is one segment, start at the loop's first node.
    std::size_t start = 0;
    while (start < n && own(start) == own(start + n - 1)) ++start;
    if (start == n) start = 0;
    std::vector<Vec2> points;
    for (std::size_t from = start, to = start; from < start + n; from = to) {
        while (to < start + n && own(to) == own(from)) ++to;
        add_divided(task.region.points, loop, from, to, counts[own(from)], points);
    }
    return points;
}

} // namespace lacuna::quads
