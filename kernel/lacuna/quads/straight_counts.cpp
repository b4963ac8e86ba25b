// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/straight_counts.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/quads/detail/face_pattern.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/pattern_ring.h>
#include <lacuna/quads/detail/pave_choice.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/segment_symmetry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

namespace lacuna::quads {
namespace {

bool may_be_tried(const CountTask& task, const StraightOptions& options)
{
    return !options.is_part && quads_asked(task) < kFewQuads;
}

/// The loops of a region with headings in a straight grid.
struct HeadedLoops {
    std::vector<PatternLoop> loops;
    LoopFrame frame;
    TurnStyle style = TurnStyle::soft;
    int fitting = 1;    ///< number of rows that suits the soft turns (`fitting_rows()`)
    bool turns = false; ///< whether there are soft turns
};

/// @return empty if a loop does not turn once around.
std::optional<HeadedLoops> head_loops(const PlanarRegion& region, TurnStyle style)
{
    HeadedLoops headed{{}, straight_frame(region), style};
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        auto loop = head_loop(region.points, region.loops[l], headed.frame, style);
        if (!loop || loop->turns != (l == 0 ? 4 : -4)) return std::nullopt;
        headed.fitting = std::max(headed.fitting, fitting_rows(*loop));
        headed.turns = headed.turns || std::ranges::find(loop->movable, 1) != loop->movable.end();
        headed.loops.push_back(std::move(*loop));
    }
    return headed;
}

/// A loop with its current numbers of sides, in a straight grid.
struct LoopGrid {
    std::vector<Vec2> points;
    GridLoop grid;
    std::size_t laid = 0; ///< number of quads in the rows between the loop and the grid

    /// Number of quads that the loop contributes: the quads inside the outer loop, or minus the quads that a
    /// hole removes.
    [[nodiscard]] double quads() const
    {
        double twice = 0;
        for (std::size_t i = 0, n = grid.positions.size(); i < n; ++i) {
            const GridPosition &a = grid.positions[i], &b = grid.positions[(i + 1) % n];
            twice += static_cast<double>(a[0]) * b[1] - static_cast<double>(a[1]) * b[0];
        }
        return twice / 2 + static_cast<double>(laid);
    }
};

std::optional<LoopGrid> loop_grid(const CountTask& task, std::size_t l, const CountedLoop& counted,
                                  const HeadedLoops& as, int rows)
{
    const Cycle& loop = task.region.loops[l];
    LoopGrid made{divided_loop(task, loop, counts_of(task, {counted})), {}};
    double length = 0;
    for_sides_of({loop}, [&](Index a, Index b) {
        length += (task.region.points[index(b)] - task.region.points[index(a)]).norm();
    });
    std::vector<Index> nodes(made.points.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    auto headed = head_loop(made.points, nodes, as.frame, as.style);
    if (headed) set_soft_rows(*headed, rows);
    const double mean = length / static_cast<double>(nodes.size());
    std::vector<Quad> quads;
    if (!headed || !lay_pattern_rows(*headed, made.points, quads, [&](const Vec2&) { return mean; }) ||
        !close_pattern_loop(*headed, 0))
        return std::nullopt;
    made.grid = positions_of(*headed);
    made.laid = quads.size();
    return made;
}

/// Whether the holes have room in the outer loop's grid, each at its interpolated position and apart from the
/// others.
bool have_place(const std::vector<LoopGrid>& grids)
{
    std::vector<GridLoop> loops;
    for (const LoopGrid& own : grids) {
        loops.push_back(own.grid);
        if (loops.size() == 1) continue;
        Vec2 by = Vec2::Zero();
        for (std::size_t i = 0; i < own.grid.nodes.size(); ++i) {
            const Vec2& p = own.points[index(own.grid.nodes[i])];
            const GridPosition& at = own.grid.positions[i];
            by += (mean_value_position(grids[0].points, grids[0].grid, p) - Vec2(at[0], at[1])) /
                  static_cast<double>(own.grid.nodes.size());
        }
        if (!by.allFinite()) return false;
        for (GridPosition& at : loops.back().positions) {
            at[0] += static_cast<int>(std::lround(by.x()));
            at[1] += static_cast<int>(std::lround(by.y()));
        }
    }
    return SubmapGrid(loops).enclose(loops);
}

/// Whether some quads between two loops would be much flatter than the size requires.
bool are_close(const CountTask& task)
{
    const double narrow = kShortestOfSize * mean_size(task);
    const PlanarRegion& region = task.region;
    for (std::size_t l = 1; l < region.loops.size(); ++l) {
        for (std::size_t m = 0; m < l; ++m) {
            if (ring_widths(region.points, region.loops[m], region.loops[l]).least < narrow) return true;
        }
    }
    return false;
}

/// Give a hole an even number of columns if its centre lies on a line of the outer loop's grid, and an odd
/// number if it lies between two lines. The same applies to rows. A hole in the middle of a plate then stays
/// in the middle.
void centre_holes(const CountTask& task, std::vector<CountedLoop>& loops, const LoopGrid& outer)
{
    for (std::size_t l = 1; l < loops.size(); ++l) {
        const Vec2 middle = mean_value_position(outer.points, outer.grid,
                                                centre_of(task.region.points, task.region.loops[l]));
        for (int k = 0; k < 2; ++k) {
            const double off = std::abs(middle[k] - std::round(middle[k]));
            int across = loops[l].added[index(k)];
            for (const CountedRun& run : loops[l].runs) across += run.quarter == k ? run.count : 0;
            if ((off > 0.25) != (across % 2 != 0)) change_both(task, loops[l], k);
        }
    }
}

/// Loops that close in the grid, for one number of rows at soft turns and one factor on the wanted numbers of
/// sides.
struct ClosedLoops {
    std::vector<CountedLoop> loops;
    std::vector<LoopGrid> grids; ///< grids of the loops that have one
    double cost = 0, quads = 0;
    int soft = 0;
};

std::optional<ClosedLoops> close_loops(const CountTask& task, const HeadedLoops& headed, int rows,
                                       double share, const CountRange& range)
{
    ClosedLoops closed;
    for (const PatternLoop& own : headed.loops) {
        PatternLoop loop = own;
        set_soft_rows(loop, rows);
        auto counts = counted_loop(task, std::move(loop), share);
        if (!counts || !close_counts(task, *counts, range)) return std::nullopt;
        for (CountedRun& run : counts->runs) run.wanted /= share;
        closed.cost += sum_of_costs(*counts);
        closed.soft += counts->soft;
        closed.loops.push_back(std::move(*counts));
    }
    return closed;
}

void add_grids(const CountTask& task, const HeadedLoops& headed, int rows, ClosedLoops& closed)
{
    for (std::size_t l = 0; l < closed.loops.size(); ++l) {
        auto grid = loop_grid(task, l, closed.loops[l], headed, rows);
        if (!grid) continue;
        closed.quads += grid->quads();
        closed.grids.push_back(std::move(*grid));
    }
}

/// The numbers of sides of all runs, by which equal solutions are recognised.
std::vector<int> run_counts(const ClosedLoops& closed)
{
    std::vector<int> counts;
    for (const CountedLoop& loop : closed.loops) {
        for (const CountedRun& run : loop.runs) counts.push_back(run.count);
    }
    return counts;
}

/// Solutions for one style of ends. Several numbers of rows in front of soft turns and several factors on the
/// wanted sides are tried.
/// @return  the solutions with their costs. For a part, only solutions that may be the cheapest one.
std::vector<Counts> counts_looked_at(const CountTask& task, const StraightOptions& options, TurnStyle style)
{
    // Cost of mirrored segments with unequal numbers; it nearly excludes them. Not measured.
    constexpr double kUnlike = 10;
    // Not measured:
    // - kOff: cost if the number of quads differs too much from the requested one, or if holes have no room
    //   in the grid;
    // - kNearAsked: the search ends at this relative deviation from the requested number of quads;
    // - kMany: from this number of requested quads on, the room for holes in a whole region is not checked.
    constexpr double kOff = 2, kNearAsked = 0.1, kMany = 2000;
    // Factors on the wanted sides; not measured.
    constexpr std::array<double, 7> kShares{1, 0.9, 0.8, 1.1, 0.65, 1.25, 1.5};
    constexpr std::size_t kNear = 4; // the first of these factors, which are tried within the promised range
    const double asked = quads_asked(task);
    const auto headed = head_loops(task.region, style);
    if (!headed || (options.few && are_close(task))) return {};
    const std::vector<SegmentPair> pairs = mirrored_segments(task.region, task.segment);
    std::vector<Counts> all;
    double least = kInfinity; // the lowest cost so far
    // More rows are tried only for a part with soft turns. Only a part has axes that can take up the
    // additional sides, and without soft turns the number of rows has no effect.
    const std::vector<int> all_rows = options.is_part && headed->turns ? rows_to_try(headed->fitting)
                                                                       : std::vector<int>{1};
    const bool wide = options.range.most > kSegment.most;
    const std::span<const double> shares = std::span(kShares).first(wide ? kShares.size() : kNear);
    for (const int rows : all_rows) {
        std::set<std::vector<int>> known;
        for (const double share : shares) {
            auto closed = close_loops(task, *headed, rows, share, options.range);
            if (!closed) continue;
            if (!known.insert(run_counts(*closed)).second) continue;
            Counts counts{counts_of(task, closed->loops), closed->cost};
            // A symmetric region needs symmetric numbers.
            if (!options.is_part && !are_alike(counts.sides, pairs)) continue;
            double of_part = 0;
            if (options.is_part) {
                const int fitting = headed->fitting;
                const double off = std::log(static_cast<double>(rows) / fitting);
                of_part = closed->soft * std::max(1.0, fitting / 2.0) * off * off +
                          kUnlike * unlike(counts.sides, pairs);
                if (counts.cost + of_part >= least) continue;
            }
            add_grids(task, *headed, rows, *closed);
            const bool has_grids = closed->grids.size() == closed->loops.size();
            const double quads = has_grids ? closed->quads : asked; // unknown if a loop has no grid
            counts.cost += kWeightOfQuads * (quads - asked) * (quads - asked) / asked + of_part;
            const bool fits = std::abs(quads - asked) <= kNearAsked * asked;
            if (std::abs(quads - asked) > kQuadsOff * asked) counts.cost += kOff;
            // Check that the grid has room for the holes. A grid with few lines may not have room. With many
            // lines the check is slow and not needed.
            const bool looks = options.is_part ? options.few : asked < kMany;
            const bool has_place = !looks || (has_grids && have_place(closed->grids));
            if (!has_place) counts.cost += kOff;
            if (!options.few || has_place) {
                least = std::min(least, counts.cost);
                all.push_back(counts);
                if (closed->loops.size() > 1 && !closed->grids.empty()) {
                    centre_holes(task, closed->loops, closed->grids.front());
                    all.back().sides = counts_of(task, closed->loops);
                    // `best_filled()` chooses between the numbers before and after centring the holes.
                    if (may_be_tried(task, options)) all.push_back(std::move(counts));
                }
            }
            if (!options.is_part && fits && has_place) return all;
        }
    }
    return all;
}

bool is_cheaper(const Counts& a, const Counts& b) { return a.cost < b.cost; }

/// Score of the best grid that `fill_patterns()` makes with these numbers of sides. It is the grid's
/// `paving::score_of()`, minus a penalty for a number of quads that differs from the requested one. Nodes are
/// spaced evenly along the region's own sides, so round segments become slightly flatter. Empty if no grid
/// can be made.
std::optional<double> score_of_counts(const CountTask& task, std::span<const int> counts)
{
    // Penalty for the number of quads. It is kWorth if the number differs by a quarter from the requested
    // one, and quadratic in this difference. Mean scaled Jacobians usually differ by less than kWorth.
    constexpr double kWorth = 0.2;
    const double asked = quads_asked(task);
    PlanarRegion made;
    made.size = task.region.size;
    made.row_height = task.region.row_height;
    for (const Cycle& loop : task.region.loops) {
        Cycle& nodes = made.loops.emplace_back();
        for (const Vec2& p : divided_loop(task, loop, counts)) {
            nodes.push_back(static_cast<Index>(made.points.size()));
            made.points.push_back(p);
        }
    }
    const std::vector<PlanarQuads> meshes = fill_patterns(made);
    made.size = paving::sizes_with_boundary(made).ring;
    std::optional<double> best;
    for (const PlanarQuads& mesh : meshes) {
        const double off = (static_cast<double>(mesh.quads.size()) / asked - 1) / kQuadsOff;
        best = std::max(best.value_or(-1), paving::score_of(measure_plane(mesh, made)) - kWorth * off * off);
    }
    return best;
}

/// The solution whose grid has the best measured quality. Solutions are tried in order of their cost until a
/// grid is good. Empty if no grid is valid, or if there is only one solution.
std::optional<Counts> best_filled(const CountTask& task, std::vector<Counts> all)
{
    constexpr double kGood = 3.1; // score at which the search ends, to limit the time. Not measured
    std::ranges::stable_sort(all, is_cheaper);
    const auto alike = [](const Counts& a, const Counts& b) { return a.sides == b.sides; };
    all.erase(std::unique(all.begin(), all.end(), alike), all.end());
    if (all.size() < 2) return std::nullopt;
    std::optional<Counts> best;
    double most = -kInfinity;
    for (std::size_t i = 0; i < std::min(kCandidates, all.size()) && most < kGood; ++i) {
        const auto score = score_of_counts(task, all[i].sides);
        if (!score || *score <= most) continue;
        most = *score;
        best = all[i];
    }
    return best;
}

} // namespace

std::optional<Counts> straight_counts(const CountTask& task, const StraightOptions& options)
{
    // The cost of solutions with soft turns at ends of 135° is divided by this number, which was chosen like
    // `kWeightOfQuads`.
    constexpr double kSoft = 2;
    std::vector<Counts> all = counts_looked_at(task, options, TurnStyle::soft);
    const auto add = [&](TurnStyle style) {
        for (Counts& counts : counts_looked_at(task, options, style)) all.push_back(std::move(counts));
    };
    if (may_be_tried(task, options) && has_doubtful_turns(task.region)) add(TurnStyle::few_soft);
    for (Counts& counts : all) counts.cost /= kSoft;
    if (has_half_ends(task.region)) add(TurnStyle::hard_ends);
    const auto least = std::ranges::min_element(all, is_cheaper);
    if (least == all.end()) return std::nullopt;
    Counts best = *least;
    if (may_be_tried(task, options)) {
        if (auto filled = best_filled(task, std::move(all))) return filled;
    }
    return best;
}

} // namespace lacuna::quads
