// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/face_pattern.h>

#include <lacuna/core/message.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/patch_template.h>
#include <lacuna/quads/detail/pattern_loop.h>
#include <lacuna/quads/detail/pattern_ring.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/row_heights.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <algorithm>
#include <cmath>

namespace lacuna::quads {
namespace {

/// A position around a ring, as a coordinate from 0 to below the period.
int wrapped(int along, int period) { return ((along % period) + period) % period; }

/// The grid lines that lead from the outer loop to the hole of a ring: one line for every side along the
/// ring.
class Spokes {
public:
    /// @param outer, inner  closed loops. `outer` runs once around the ring in the direction of the first
    ///         grid axis, and `inner` once in the opposite direction.
    Spokes(const std::vector<Vec2>& points, const GridLoop& outer, const GridLoop& inner, int period)
        : outer_(ends_of(points, outer, period, true)), inner_(ends_of(points, inner, period, false))
    {
        turn_inner();
    }

    /// Offset along the ring of the inner loop's positions.
    [[nodiscard]] int shift() const { return shift_; }

    /// Number of rows between the loops that gives rows of the requested height.
    [[nodiscard]] int rows(const SizeField& size) const
    {
        double sum = 0;
        int least = 1;
        for (std::size_t u = 0; u < outer_.size(); ++u) {
            const Vec2 &a = outer_[u].at, &b = inner_[u].at;
            const int taken = outer_[u].row - inner_[u].row;
            sum += (b - a).norm() / size((a + b) / 2) + taken;
            least = std::max(least, taken + 1);
        }
        return std::max(least, static_cast<int>(std::lround(sum / static_cast<double>(outer_.size()))));
    }

    /// Grid coordinates of a point between the loops. Empty if the point is not between two neighbouring
    /// spokes.
    [[nodiscard]] std::optional<Vec2> position(const Vec2& p, int rows) const
    {
        const std::size_t n = outer_.size();
        for (std::size_t u = 0; u < n; ++u) {
            const std::size_t v = (u + 1) % n;
            const double here = side_of(u, p), there = side_of(v, p);
            if (!(here >= 0 && there < 0)) continue;
            const double along = here / (here - there);
            const Vec2 from = (1 - along) * outer_[u].at + along * outer_[v].at;
            const Vec2 to = (1 - along) * inner_[u].at + along * inner_[v].at;
            const double across = (p - from).dot(to - from) / (to - from).squaredNorm();
            if (!(across > 0 && across < 1)) continue;
            const double low = (1 - along) * outer_[u].row + along * outer_[v].row;
            const double high = rows + (1 - along) * inner_[u].row + along * inner_[v].row;
            return Vec2(static_cast<double>(u) + along, low + across * (high - low));
        }
        return std::nullopt;
    }

    /// Direction along the ring at a point [radians].
    [[nodiscard]] double angle(const Vec2& p) const
    {
        const auto at = position(p, 1);
        const std::size_t u = at ? static_cast<std::size_t>(at->x()) % outer_.size() : 0;
        const Vec2 across = inner_[u].at - outer_[u].at;
        return std::atan2(-across.x(), across.y());
    }

private:
    struct End {
        Vec2 at = Vec2::Zero();
        int row = 0;
    };

    /// For each position along the ring, the node of a loop at this position. If there are several, the node
    /// farthest inside the region.
    static std::vector<End> ends_of(const std::vector<Vec2>& points, const GridLoop& loop, int period,
                                    bool outer)
    {
        std::vector<End> ends(index(period));
        std::vector<char> set(ends.size(), 0);
        for (std::size_t i = 0; i < loop.nodes.size(); ++i) {
            const auto at = index(wrapped(loop.positions[i][0], period));
            const int row = loop.positions[i][1];
            if (set[at] && (outer ? row <= ends[at].row : row >= ends[at].row)) continue;
            set[at] = 1;
            ends[at] = {points[index(loop.nodes[i])], row};
        }
        return ends;
    }

    /// Shift the inner loop along the ring so that the spokes are shortest.
    void turn_inner()
    {
        const std::size_t n = outer_.size();
        // On a large loop, only 64 to 127 spokes are evaluated for each shift of the inner loop. On a small
        // loop, all are evaluated.
        const std::size_t step = std::max<std::size_t>(1, n / 64);
        double least = kInfinity;
        std::size_t best = 0;
        for (std::size_t by = 0; by < n; ++by) {
            double sum = 0;
            for (std::size_t u = 0; u < n; u += step)
                sum += (outer_[u].at - inner_[(u + by) % n].at).squaredNorm();
            if (sum >= least) continue;
            least = sum;
            best = by;
        }
        std::rotate(inner_.begin(), inner_.begin() + static_cast<std::ptrdiff_t>(best), inner_.end());
        shift_ = -static_cast<int>(best);
    }

    /// Signed distance of a point from spoke u. It is positive if the point is ahead of the spoke along the
    /// ring.
    [[nodiscard]] double side_of(std::size_t u, const Vec2& p) const
    {
        const Vec2 across = inner_[u].at - outer_[u].at;
        return cross(p - outer_[u].at, across) / across.norm();
    }

    std::vector<End> outer_, inner_;
    int shift_ = 0;
};

/// The nearest integer. Values halfway between two integers, up to rounding errors, are rounded down. Holes
/// that are images of each other are thus all moved in the same direction.
int nearest(double x) { return static_cast<int>(std::ceil(x - 0.5 - kFileAccuracy)); }

void move(GridLoop& loop, int along, int across, int period)
{
    for (GridPosition& p : loop.positions) {
        p = {p[0] + along, p[1] + across};
        if (period > 0) p[0] = wrapped(p[0], period);
    }
}

/// One way to fill a region with a grid.
struct FacePattern {
    std::size_t about = 0; ///< the loop that the grid lines follow; 0: the lines are straight
    /// Number of rows of quads between the round parts of a loop and the places where the grid turns.
    int rows = 1;
    int steps = 0; ///< number of rows by which the outer loop of a ring steps inward where the ring is narrow
    int corners = 0; ///< number of nodes at which rows of a ring change their number of sides
    TurnStyle style = TurnStyle::soft;
    int across = 0; ///< number of rows between the loops of a ring; 0: as many as the size gives
};

/// If quads fold, move each inner node to the mean of its neighbours a few times. Keep the result if the
/// worst quad has improved. Where rows overlap, this is far faster than the untangling in `smooth_plane()`.
void spread_folds(PlanarQuads& mesh, std::size_t fixed)
{
    const double before = least_scaled_jacobian(mesh.points, mesh.quads);
    if (before > 0) return;
    std::vector<Vec2> points = mesh.points, sum(points.size());
    std::vector<int> sides(points.size());
    for (int sweep = 0; sweep < kMostSteps; ++sweep) {
        std::fill(sum.begin(), sum.end(), Vec2::Zero());
        std::fill(sides.begin(), sides.end(), 0);
        for (const Quad& quad : mesh.quads) {
            for (std::size_t k = 0; k < 4; ++k) {
                const auto a = index(quad[k]), b = index(quad[(k + 1) % 4]);
                sum[a] += points[b];
                sum[b] += points[a];
                ++sides[a];
                ++sides[b];
            }
        }
        for (std::size_t p = fixed; p < points.size(); ++p) {
            if (sides[p] > 0) points[p] = sum[p] / sides[p];
        }
    }
    if (least_scaled_jacobian(points, mesh.quads) > before) mesh.points = std::move(points);
}

/// The mesh after smoothing of its inner nodes and correction of its row heights. Empty if this mesh has a
/// fault.
std::optional<PlanarQuads> smoothed(PlanarQuads mesh, const PlanarRegion& region, const SizeField& size,
                                    const RunContext& context)
{
    smooth_plane(mesh.points, mesh.quads, region.points.size(), {.size = size}, context);
    paving::correct_row_heights(mesh, region, size);
    if (!find_fault(mesh, region).empty()) return std::nullopt;
    return mesh;
}

class PatternFiller {
public:
    PatternFiller(const PlanarRegion& region, const FacePattern& pattern, const SizeField& size)
        : region_(region), pattern_(pattern), size_(size), points_(region.points), loops_(region.loops.size())
    {
    }

    std::optional<PlanarQuads> run(const RunContext& context)
    {
        if (!(pattern_.about > 0 ? place_round() : place_straight())) return std::nullopt;
        SubmapGrid grid(grid_, period_);
        if (!grid.enclose(grid_)) return std::nullopt;
        PlanarQuads mesh{std::move(points_), std::move(quads_), words()};
        grid.add_cells(mesh);
        // The nodes of a narrow ring lie evenly on lines between its loops; smoothing is for square quads.
        if (pattern_.across > 0) return mesh;
        spread_folds(mesh, region_.points.size());
        return smoothed(std::move(mesh), region_, size_, context);
    }

    /// Number of soft turns of all loops.
    [[nodiscard]] std::ptrdiff_t turns() const { return soft_; }

    /// If the outer loop and the hole that the grid lines follow form a ring: number of sides of the outer
    /// loop minus that of the hole.
    [[nodiscard]] int more_sides() const { return more_sides_; }
    /// Whether rows along one of the loops of a ring may change their number of sides.
    [[nodiscard]] bool may_change() const { return may_change_; }

private:
    [[nodiscard]] std::string words() const
    {
        if (soft_ == 0) return pattern_.about == 0 ? "submapped" : "rings";
        return formatted("{} with {} turns", pattern_.about == 0 ? "grid" : "rings", soft_);
    }

    bool head(std::size_t l, const LoopFrame& frame, int turns)
    {
        auto headed = head_loop(region_.points, region_.loops[l], frame, pattern_.style);
        if (!headed) return false;
        set_soft_rows(*headed, pattern_.rows);
        loops_[l] = std::move(*headed);
        soft_ += std::ranges::count(loops_[l].movable, 1);
        return loops_[l].turns == turns;
    }

    bool close(std::size_t l, int period)
    {
        PatternLoop& loop = loops_[l];
        if (!lay_pattern_rows(loop, points_, quads_, size_) || !close_pattern_loop(loop, period))
            return false;
        grid_[l] = positions_of(loop);
        return true;
    }

    bool place_straight()
    {
        const LoopFrame frame = straight_frame(region_);
        grid_.resize(loops_.size());
        for (std::size_t l = 0; l < loops_.size(); ++l) {
            if (!head(l, frame, l == 0 ? 4 : -4) || !close(l, 0)) return false;
        }
        for (std::size_t l = 1; l < loops_.size(); ++l) {
            std::vector<Vec2> goal;
            for (const Index p : grid_[l].nodes)
                goal.push_back(mean_value_position(points_, grid_[0], points_[index(p)]));
            if (!settle(l, goal)) return false;
        }
        return true;
    }

    /// Mean difference between the goals of a loop's nodes and their grid coordinates.
    static Vec2 way_to(const std::vector<Vec2>& goal, const GridLoop& grid)
    {
        Vec2 sum = Vec2::Zero();
        for (std::size_t i = 0; i < goal.size(); ++i)
            sum += goal[i] - Vec2(grid.positions[i][0], grid.positions[i][1]);
        return sum / static_cast<double>(goal.size());
    }

    /// Move a hole to the grid position nearest to its goal. If the goal is halfway between two grid lines in
    /// both directions, a round hole is made one column narrower and one row higher, which places it on grid
    /// lines.
    /// @return  false if the hole has no position in the grid.
    bool settle(std::size_t l, const std::vector<Vec2>& goal)
    {
        const auto off = [](const Vec2& by) {
            return (by - by.unaryExpr([](double x) { return std::round(x); })).norm();
        };
        Vec2 by = way_to(goal, grid_[l]);
        PatternLoop traded = loops_[l];
        if (by.allFinite() && trade_column_for_row(traded)) {
            GridLoop other = positions_of(traded);
            const Vec2 now = way_to(goal, other);
            if (off(now) < off(by) - kFileAccuracy) {
                grid_[l] = std::move(other);
                by = now;
            }
        }
        if (!(by.cwiseAbs().maxCoeff() < static_cast<double>(points_.size()))) return false;
        move(grid_[l], nearest(by.x()), nearest(by.y()), period_);
        return true;
    }

    bool place_round()
    {
        grid_.resize(loops_.size());
        for (const std::size_t l : {std::size_t{0}, pattern_.about}) {
            const LoopFrame frame{true, centre_of(region_.points, region_.loops[l])};
            if (!head(l, frame, 0) || !is_ring_loop(region_.points, loops_[l])) return false;
        }
        if (!make_alike(loops_[0], loops_[pattern_.about])) return false;
        for (const std::size_t l : {std::size_t{0}, pattern_.about}) {
            if (period_ < 3 || !close(l, l == 0 ? period_ : -period_)) return false;
            move(grid_[l], 0, 0, period_);
        }
        const Spokes spokes(points_, grid_[0], grid_[pattern_.about], period_);
        int rows = spokes.rows(size_);
        if (pattern_.across > 0) {
            if (rows >= pattern_.across) return false;
            rows = pattern_.across;
        }
        move(grid_[pattern_.about], spokes.shift(), rows, period_);
        for (std::size_t l = 1; l < loops_.size(); ++l) {
            if (l != pattern_.about && !place_beside(l, spokes, rows)) return false;
        }
        return true;
    }

    /// Give the two loops of a ring the same number of sides along the ring. The pattern determines the
    /// method: steps of the outer loop, or rows that change their number of sides.
    bool make_alike(PatternLoop& outer, PatternLoop& inner)
    {
        more_sides_ = along(outer) + along(inner);
        may_change_ = runs_round(outer) || runs_round(inner);
        if (pattern_.steps > 0) {
            if (!runs_round(outer)) return false;
            const RingWidths widths = ring_widths(points_, outer.nodes, inner.nodes);
            if (!step_in(outer, widths.narrowest, widths.half, pattern_.steps)) return false;
            soft_ += 4;
        }
        const int by = more_sides_ - 2 * pattern_.steps;
        if (pattern_.corners > 0 && by != 0) {
            PatternLoop& loop = pattern_.steps == 0 && runs_round(outer) ? outer : inner;
            if (!runs_round(loop) ||
                !change_sides(loop, &loop == &outer ? -by : by, pattern_.corners, points_, quads_, size_))
                return false;
            soft_ += 2L * pattern_.corners;
        }
        period_ = along(outer);
        return period_ == -along(inner);
    }

    /// Number of sides along heading 0 minus the number in the opposite direction.
    static int along(const PatternLoop& loop)
    {
        int sum = 0;
        for (const int h : loop.heading) sum += grid_step(h)[0];
        return sum;
    }

    /// Place a hole that the grid lines do not follow.
    bool place_beside(std::size_t l, const Spokes& spokes, int rows)
    {
        const LoopFrame frame{false, Vec2::Zero(), spokes.angle(centre_of(region_.points, region_.loops[l]))};
        if (!head(l, frame, -4) || !close(l, 0)) return false;
        std::vector<Vec2> goal;
        for (const Index p : grid_[l].nodes) {
            const auto at = spokes.position(points_[index(p)], rows);
            if (!at) return false;
            goal.push_back(*at);
            if (goal.size() == 1) continue;
            const double last = goal[goal.size() - 2].x();
            goal.back().x() = last + std::remainder(goal.back().x() - last, period_);
        }
        return settle(l, goal);
    }

    const PlanarRegion& region_;
    FacePattern pattern_;
    const SizeField& size_;
    std::vector<Vec2> points_;
    std::vector<Quad> quads_;
    std::vector<PatternLoop> loops_;
    std::vector<GridLoop> grid_;
    int period_ = 0;
    std::ptrdiff_t soft_ = 0;
    int more_sides_ = 0;
    bool may_change_ = false;
};

/// The patterns for a ring whose loops have different numbers of sides. The patterns with the fewest
/// irregular nodes come first.
std::vector<FacePattern> unlike_rings(const PlanarRegion& region, const SizeField& size, std::size_t about,
                                      int more_sides)
{
    const RingWidths widths = ring_widths(region.points, region.loops[0], region.loops[about]);
    const double height = size(region.points[index(region.loops[about].front())]);
    const int pairs = std::abs(more_sides) / 2, rows = widths.changing(height);
    std::vector<FacePattern> patterns;
    if (widths.steps(height) > 0) {
        if (more_sides > 0 && pairs <= rows) patterns.push_back({about, 1, pairs, 0});
        return patterns;
    }
    for (int corners = 1; corners <= pairs && patterns.size() < kCandidates; ++corners) {
        if ((pairs + corners - 1) / corners <= rows) patterns.push_back({about, 1, 0, corners});
    }
    return patterns;
}

/// Whether no quad of a mesh is poor, nearly all have the requested size, and the rows along the boundary
/// are good. With higher bounds, the search continues more often and finds better meshes, but takes longer.
bool is_fine(const PlaneQuality& quality, double least, double rows)
{
    return quality.min_scaled_jacobian > least && quality.size_share() > kPromisedShare &&
           quality.row_share() >= rows;
}

/// The corners of the only loop of a region: the nodes whose angle suits one quad. Empty if the angle of some
/// node suits more than two quads.
std::vector<std::size_t> lone_corners(const PlanarRegion& region)
{
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < region.loops[0].size(); ++i) {
        const int quads = quads_in(corner_angle(region.points, region.loops[0], i));
        if (quads > 2) return {};
        if (quads < 2) corners.push_back(i);
    }
    return corners;
}

/// Tries several ways to fill a region, the most promising first, until the result can hardly improve.
class PatternTrial {
public:
    PatternTrial(const PlanarRegion& region, const RunContext& context)
        : region_(region),
          context_(context),
          sizes_(paving::sizes_with_boundary(region)),
          has_half_ends_(has_half_ends(region))
    {
    }

    void run()
    {
        for (std::size_t l = 1; l < region_.loops.size() && !is_fine_; ++l) try_round(l);
        if (!is_fine_) try_straight(TurnStyle::soft);
        if (!is_square_ && has_half_ends_) try_straight(TurnStyle::hard_ends);
        if (!is_square_ && has_doubtful_turns(region_)) try_straight(TurnStyle::few_soft);
        if (!is_square_ && region_.loops.size() == 1) try_corners();
    }

    /// The meshes that were found. The number of quads matters if the region has no holes, or has ends of
    /// 135°. Then only meshes with about the requested number are returned, if there are any.
    std::vector<PlanarQuads> take()
    {
        std::vector<PlanarQuads> fit;
        for (std::size_t i = 0; i < made_.size(); ++i) {
            if (fits_[i]) fit.push_back(std::move(made_[i]));
        }
        return fit.empty() ? std::move(made_) : std::move(fit);
    }

private:
    /// Try grid lines that follow a hole.
    void try_round(std::size_t about)
    {
        const PatternFiller like = fill({about, 1});
        if (like.more_sides() % 2 != 0 || like.more_sides() == 0 || !like.may_change()) return;
        for (const FacePattern& unlike : unlike_rings(region_, sizes_.ring, about, like.more_sides())) {
            fill(unlike);
            if (is_square_) return;
        }
    }

    /// Try straight grid lines.
    void try_straight(TurnStyle style)
    {
        const std::size_t before = made_.size();
        for (const int rows : rows_to_try(fitting_rows(style))) {
            if (is_fine_ || (is_square_ && made_.size() >= before + kCandidates)) return;
            const PatternFiller filler = fill({0, rows, 0, 0, style});
            if (filler.turns() == 0) return; // the number of rows has no effect without soft turns
        }
    }

    /// Number of rows that suits the soft turns of all loops in a straight grid.
    [[nodiscard]] int fitting_rows(TurnStyle style) const
    {
        const LoopFrame frame = straight_frame(region_);
        int most = 1;
        for (const Cycle& loop : region_.loops) {
            const auto headed = head_loop(region_.points, loop, frame, style);
            if (headed) most = std::max(most, quads::fitting_rows(*headed));
        }
        return most;
    }

    /// Try one grid at each corner, if there are only a few corners.
    void try_corners()
    {
        const std::vector<std::size_t> corners = lone_corners(region_);
        if (corners.size() < 3 || corners.size() > kMostSides) return;
        const std::vector<Vec2> loop = region_within(region_.points, {region_.loops[0]}).region.points;
        for (const TemplateCut& cut : find_cuts(loop, corners, 1)) {
            check_cancelled(context_);
            if (auto mesh = fill_corners(loop, corners, cut)) keep(std::move(*mesh));
        }
    }

    [[nodiscard]] std::optional<PlanarQuads> fill_corners(const std::vector<Vec2>& loop,
                                                          const std::vector<std::size_t>& corners,
                                                          const TemplateCut& cut) const
    {
        const TemplateMesh filled = fill_template(loop, corners, cut);
        PlanarQuads mesh{region_.points, {}, formatted("grids at {} corners", corners.size())};
        add_filling(mesh.points, mesh.quads, region_.loops[0], filled.inner, filled.quads);
        return smoothed(std::move(mesh), region_, sizes_.usual, context_);
    }

    void keep(PlanarQuads mesh)
    {
        // Scaled Jacobians of the worst quad at which parts of the search end. Above kSquare, hard ends of
        // 135° and rows that change their number of quads are not tried. Above kFine, if also the share of
        // good rows is above kPromisedShare, nothing else is tried. Meshes of discs never exceed kFine.
        constexpr double kSquare = 0.75, kFine = 0.85;
        made_.push_back(std::move(mesh));
        const bool decides = has_half_ends_ || region_.loops.size() == 1;
        fits_.push_back(!decides || paving::has_quads_asked(made_.back(), sizes_.usual) ? 1 : 0);
        if (!fits_.back()) return;
        const PlaneQuality quality = measure_plane(made_.back(), region_);
        is_square_ = is_square_ || quads::is_fine(quality, kSquare, 0);
        is_fine_ = is_fine_ || quads::is_fine(quality, kFine, kPromisedShare);
    }

    PatternFiller fill(const FacePattern& pattern)
    {
        check_cancelled(context_);
        PatternFiller filler(region_, pattern, pattern.about > 0 ? sizes_.ring : sizes_.usual);
        if (auto mesh = filler.run(context_)) keep(std::move(*mesh));
        return filler;
    }

    const PlanarRegion& region_;
    const RunContext& context_;
    const paving::BoundarySizes sizes_;
    std::vector<PlanarQuads> made_;
    /// For each mesh, whether it has the requested number of quads, or this number does not matter.
    std::vector<char> fits_;
    const bool has_half_ends_;
    bool is_square_ = false; ///< whether some mesh has nearly square quads
    bool is_fine_ = false;   ///< whether some mesh also has good rows
};

} // namespace

std::vector<PlanarQuads> fill_patterns(const PlanarRegion& region, const RunContext& context)
{
    PatternTrial trial(region, context);
    trial.run();
    return trial.take();
}

std::optional<PlanarQuads> fill_narrow_ring(const PlanarRegion& region, int rows, const RunContext& context)
{
    if (region.loops.size() != 2) return std::nullopt;
    FacePattern pattern{.about = 1};
    pattern.across = rows;
    const paving::BoundarySizes sizes = paving::sizes_with_boundary(region);
    auto mesh = PatternFiller(region, pattern, sizes.ring).run(context);
    if (mesh &&
        (least_scaled_jacobian(mesh->points, mesh->quads) < kPoorQuad || !find_fault(*mesh, region).empty()))
        return std::nullopt;
    return mesh;
}

} // namespace lacuna::quads
