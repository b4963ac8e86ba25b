// SPDX-License-Identifier: MIT
#include <lacuna/surface/pave.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/triangulate.h>
#include <lacuna/surface/clean_quads.h>
#include <lacuna/surface/measure_plane.h>
#include <lacuna/surface/pave_core.h>
#include <lacuna/surface/pave_fit.h>
#include <lacuna/surface/pave_refill.h>
#include <lacuna/surface/pave_repair.h>
#include <lacuna/surface/pave_rows.h>
#include <lacuna/surface/pave_size.h>
#include <lacuna/surface/pave_true_rows.h>
#include <lacuna/surface/smooth_plane.h>
#include <lacuna/surface/submap.h>
#include <lacuna/surface/triangle_quads.h>

#include <optional>
#include <sstream>

namespace lacuna::surface {
namespace {

using namespace paving;

std::string place_of(const Vec2& p)
{
    std::ostringstream text;
    text << "(" << p.x() << ", " << p.y() << ")";
    return text.str();
}

void check_region(const PlanarRegion& region)
{
    std::size_t sides = 0;
    if (region.loops.empty()) throw InvalidInput("surface.pave_loops", "a region to be paved has no outline");
    std::vector<bool> seen(region.points.size(), false);
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const auto& loop = region.loops[l];
        const std::string name = "loop " + std::to_string(l + 1) + " of a region to be paved";
        if (loop.size() < 3) {
            throw InvalidInput("surface.pave_loops",
                               name + " has " + std::to_string(loop.size()) + " nodes; give it 3 or more");
        }
        sides += loop.size();
        for (const Index p : loop) {
            if (p < 0 || static_cast<std::size_t>(p) >= seen.size())
                throw InvalidInput("surface.pave_loops", name + " names node " + std::to_string(p + 1) +
                                                             " of " + std::to_string(seen.size()));
            if (seen[static_cast<std::size_t>(p)])
                throw InvalidInput("surface.pave_loops", name + " comes to node " + std::to_string(p + 1) +
                                                             " a second time; loops may not touch");
            seen[static_cast<std::size_t>(p)] = true;
        }
    }
    if (const auto crossing = geometry::find_crossing(region.points, region.loops)) {
        const auto node = static_cast<std::size_t>(region.loops[crossing->loop_a][crossing->segment_a]);
        throw InvalidInput("surface.pave_loops", "loops " + std::to_string(crossing->loop_a + 1) + " and " +
                                                     std::to_string(crossing->loop_b + 1) +
                                                     " of a region to be paved cross or touch near " +
                                                     place_of(region.points[node]));
    }
    if (sides % 2 != 0) {
        throw InvalidInput(
            "surface.pave_parity",
            "a region with " + std::to_string(sides) +
                " boundary sides cannot be filled with quads alone; give one of its edges one side more");
    }
}

/// Is the region one good patch as it is?
bool is_patch(const Draft& draft, const std::vector<Cycle>& loops)
{
    constexpr double kGood = 0.8;
    if (loops.size() > 1 || loops.front().size() < 8) return false;
    const Fit fit = fit_patch(draft, loops.front(), angles_of(draft, loops.front()));
    return fit.quality > kGood;
}

/// Rows a loop is worth. A round outer loop gets four nodes of three quads where its rows end; with rows for
/// about a fiftieth of its length they lie where a square of the same number of nodes has its corners. Round
/// a hole every row is one more of stretched quads.
int rows_for(const Draft& draft, const Cycle& loop, bool outer)
{
    if (!needs_row(draft, loop)) return 0;
    constexpr std::size_t kNodesARow = 60;
    return outer ? 1 + static_cast<int>(loop.size() / kNodesARow) : 1;
}

/// Quads and the points they use; the region's own come first, used or not.
PlanarQuads without_loose_points(const Draft& draft)
{
    PlanarQuads mesh{{draft.points.begin(), draft.points.begin() + static_cast<std::ptrdiff_t>(draft.fixed)},
                     draft.quads};
    std::vector<Index> number(draft.points.size(), -1);
    for (std::size_t p = 0; p < draft.fixed; ++p) number[p] = static_cast<Index>(p);
    for (Quad& quad : mesh.quads) {
        for (Index& p : quad) {
            Index& own = number[static_cast<std::size_t>(p)];
            if (own < 0) {
                own = static_cast<Index>(mesh.points.size());
                mesh.points.push_back(draft.at(p));
            }
            p = own;
        }
    }
    return mesh;
}

/// Below what sine a quad counts as folded: no sweep bears a flatter one, unless the given corners are that
/// sharp.
double flat_below(const PlanarRegion& region)
{
    constexpr double kFlat = 0.02, kShare = 0.3;
    double sharpest = 1;
    for (const auto& loop : region.loops) {
        for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
            const auto at = [&](std::size_t k) {
                return region.points[static_cast<std::size_t>(loop[k % n])];
            };
            const double angle = turn_between(at(i + 1) - at(i), at(i + n - 1) - at(i));
            if (angle < kRightAngle) sharpest = std::min(sharpest, std::sin(angle));
        }
    }
    return std::min(kFlat, kShare * sharpest);
}

/// What lies along the boundary.
enum class RowStyle {
    by_shape,  ///< as many rows as each loop is worth
    one_patch, ///< none: the region is one patch
    none,      ///< the region is cut as it is
    thin,      ///< rows also where loops are near each other
    buffer,    ///< one row with two quads at least at every node, so that all other nodes are free to move
    halved_triangles, ///< no rows: `TriangleWay`
    paired_triangles,
    split_triangles
};

struct Attempt {
    PlanarQuads mesh;
    PaveReport report;
    double worst = -2;
    Vec2 where = Vec2::Zero();
};

/// Is every side used once in each direction at the most?
bool sides_match(const std::vector<Quad>& quads)
{
    std::vector<std::uint64_t> sides;
    sides.reserve(4 * quads.size());
    for (const Quad& q : quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            sides.push_back((static_cast<std::uint64_t>(static_cast<std::uint32_t>(q[k])) << 32) |
                            static_cast<std::uint32_t>(q[(k + 1) % 4]));
        }
    }
    std::sort(sides.begin(), sides.end());
    return std::adjacent_find(sides.begin(), sides.end()) == sides.end();
}

void judge(Attempt& attempt)
{
    attempt.worst = 1;
    for (const Quad& q : attempt.mesh.quads) {
        const auto at = [&](std::size_t k) { return attempt.mesh.points[static_cast<std::size_t>(q[k])]; };
        const double sine = least_sine(at(0), at(1), at(2), at(3));
        if (sine >= attempt.worst) continue;
        attempt.worst = sine;
        attempt.where = (at(0) + at(1) + at(2) + at(3)) / 4;
    }
}

/// Open what is folded: by moving nodes, with more of them, and what does not open is filled anew.
void open_folds(Attempt& attempt, const PlanarRegion& region, const Draft& draft, const PaveOptions& options,
                const RunContext& context)
{
    constexpr int kLoosenings = 3;
    for (int round = 0; round <= kLoosenings; ++round) {
        Attempt tried = attempt;
        if (round > 0) loosen_folds(tried.mesh, draft.flat);
        ease_folds(tried.mesh, draft.fixed);
        judge(tried);
        if (tried.worst <= draft.flat && round == 0 && options.clean) {
            clean_quads(tried.mesh, draft.fixed, {.size = draft.size}, context);
            ease_folds(tried.mesh, draft.fixed);
            judge(tried);
        }
        if (tried.worst <= draft.flat) {
            // What opens here is smoothed with the rest later.
            smooth_plane(tried.mesh.points, tried.mesh.quads, draft.fixed,
                         {.size = draft.size, .sweeps = 0, .repairs = 0}, context);
            judge(tried);
        }
        const bool better = round == 0 || tried.worst > attempt.worst;
        if (better) attempt = std::move(tried);
        if (!better || attempt.worst > draft.flat) break;
    }
    if (attempt.worst > 0) return;
    attempt.report.refilled = refill_folds(attempt.mesh, region, 0, draft.size);
    judge(attempt);
}

/// How good quads are, to choose between two ways; higher is better. A mean of shapes, sizes, rows and the
/// worst quad, less what is irregular; the worst quad counts double, for a sweep repeats it, up to kGood.
double score_of(const PlanarQuads& mesh, const PlanarRegion& region)
{
    constexpr double kGood = 0.6;
    const PlaneQuality quality = measure_plane(mesh, region);
    return quality.mean_scaled_jacobian + 2 * std::min(quality.min_scaled_jacobian, kGood) +
           quality.size_share() / 2 + quality.row_share() / 4 - quality.irregular_share() / 2;
}

/// Rows from the loops, the rest cut and filled.
void lay_and_fill(Attempt& attempt, Draft& draft, const PlanarRegion& region, const PaveOptions& options,
                  RowStyle style, const RunContext& context)
{
    const auto& height = options.row_height ? options.row_height : draft.size;
    std::vector<Cycle> loops = region.loops;
    if (style == RowStyle::by_shape && options.rows < 0 && is_patch(draft, loops))
        style = RowStyle::one_patch;
    std::vector<int> rows;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const int own = options.rows < 0 ? rows_for(draft, loops[l], l == 0) : options.rows;
        rows.push_back(style == RowStyle::none || style == RowStyle::one_patch ? 0
                       : style == RowStyle::buffer                             ? 1
                                                                               : own);
    }
    const RowKind kind = style == RowStyle::buffer ? RowKind::buffer
                         : style == RowStyle::thin ? RowKind::thin
                                                   : RowKind::tall;
    for (int r = 0;; ++r) {
        std::vector<bool> wanted;
        for (const int own : rows) wanted.push_back(own > r);
        if (std::none_of(wanted.begin(), wanted.end(), [](bool w) { return w; })) break;
        attempt.report.rows += lay_rows(draft, loops, wanted, height, kind);
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (!wanted[l]) rows[l] = 0;
        }
    }
    const CoreCount count = fill_core(draft, loops, style == RowStyle::one_patch, context);
    attempt.report.mapped = count.patches;
    attempt.report.cuts = count.cuts;
    attempt.report.templates = count.templates;
    attempt.report.used = count.cuts == 0 && count.patches == 1 && attempt.report.rows == 0 ? "mapped"
                                                                                            : "paved";
    attempt.mesh = without_loose_points(draft);
}

/// The way of triangles a style means, if any.
std::optional<TriangleWay> triangle_way(RowStyle style)
{
    switch (style) {
    case RowStyle::halved_triangles:
        return TriangleWay::halved;
    case RowStyle::paired_triangles:
        return TriangleWay::paired;
    case RowStyle::split_triangles:
        return TriangleWay::split;
    default:
        return std::nullopt;
    }
}

Attempt try_pave(const PlanarRegion& region, const PaveOptions& options, RowStyle style, double flat,
                 const RunContext& context)
{
    Attempt attempt;
    Draft draft{region.points, {}, region.points.size(), size_with_boundary(region), flat, {}};
    const auto& height = options.row_height ? options.row_height : draft.size;
    if (const std::optional<TriangleWay> way = triangle_way(style)) {
        attempt.mesh = quads_of_triangles(region, *way);
        attempt.report.used = "paired";
        if (attempt.mesh.quads.empty()) return attempt;
    } else {
        lay_and_fill(attempt, draft, region, options, style, context);
    }
    if (!sides_match(attempt.mesh.quads)) return attempt;
    if (style != RowStyle::split_triangles) open_corners(attempt.mesh, region);
    judge(attempt);
    if (options.smooth) open_folds(attempt, region, draft, options, context);
    if (attempt.worst <= 0) return attempt;
    if (options.clean) clean_quads(attempt.mesh, draft.fixed, {.size = draft.size}, context);
    if (options.smooth) {
        smooth_plane(attempt.mesh.points, attempt.mesh.quads, draft.fixed, {.size = draft.size}, context);
        true_rows(attempt.mesh, region, height);
    }
    judge(attempt);
    return attempt;
}

/// Try the grid of a region of right angles. @return whether it is so good that nothing else need be tried.
bool submapped(const PlanarRegion& region, const PaveOptions& options, Attempt& attempt,
               const RunContext& context)
{
    auto mesh = submap(region, context);
    if (!mesh) return false;
    attempt.mesh = std::move(*mesh);
    attempt.report.used = attempt.mesh.how;
    attempt.report.mapped = 1;
    true_rows(attempt.mesh, region, options.row_height ? options.row_height : size_with_boundary(region));
    judge(attempt);
    constexpr double kGood = 0.6, kOfSize = 0.95;
    const PlaneQuality quality = measure_plane(attempt.mesh, region);
    return quality.min_scaled_jacobian > kGood && quality.size_share() > kOfSize;
}

} // namespace

PlanarQuads pave(const PlanarRegion& region, const PaveOptions& options, const RunContext& context)
{
    check_region(region);
    // Below this many quads it costs little to pave with and without rows and keep the better.
    constexpr std::size_t kFew = 4000;
    const double flat = flat_below(region);
    Attempt best;
    double best_score = -2;
    const auto attempt = [&](RowStyle style) {
        Attempt made = try_pave(region, options, style, flat, context);
        if (made.worst > 0 && !find_fault(made.mesh, region).empty()) made.worst = -1;
        if (made.worst <= flat)
            log_line(context, "quads fold near " + place_of(made.where) + ": paving differently");
        const double score = made.worst > flat ? score_of(made.mesh, region) : made.worst;
        if (score <= best_score) return;
        best_score = score;
        best = std::move(made);
    };
    if (options.rows < 0 && submapped(region, options, best, context)) {
        if (options.report) *options.report = best.report;
        return std::move(best.mesh);
    }
    if (best.worst > flat) best_score = score_of(best.mesh, region);
    const auto is_few = [&] { return options.rows < 0 && best.mesh.quads.size() <= kFew; };
    attempt(RowStyle::by_shape);
    if (best.worst <= flat) attempt(RowStyle::buffer);
    for (const RowStyle style : {RowStyle::none, RowStyle::thin}) {
        if (best.worst <= 0 || is_few()) attempt(style);
    }
    // A worst quad poorer than this is worth another way, where that costs little.
    constexpr double kPoor = 0.5;
    for (const RowStyle style : {RowStyle::halved_triangles, RowStyle::paired_triangles}) {
        if (best.worst <= 0 || (is_few() && best.worst < kPoor)) attempt(style);
    }
    if (best.worst <= 0) attempt(RowStyle::split_triangles);
    if (best.worst <= 0) {
        throw NotSweepable("surface.pave", "no valid quads were found for a region of " +
                                               std::to_string(region.points.size()) +
                                               " boundary nodes: near " + place_of(best.where) +
                                               " they fold; try a smaller size there, or quads = \"gmsh\"");
    }
    // Between sides that all but touch, or in spikes, there are none but flat ones.
    if (best.worst <= flat) {
        log_line(context, "the flattest quad, near " + place_of(best.where) + ", has a scaled Jacobian of " +
                              std::to_string(best.worst) + ": the boundary's sides are long for the gap there");
    }
    best.mesh.how = best.report.used;
    if (options.report) *options.report = best.report;
    return std::move(best.mesh);
}

} // namespace lacuna::surface
