// SPDX-License-Identifier: MIT
#include <lacuna/quads/pave.h>

#include <lacuna/core/error.h>
#include <lacuna/geometry/predicates.h>
#include <lacuna/geometry/triangulate.h>
#include <lacuna/quads/detail/pave_attempt.h>
#include <lacuna/quads/detail/open_corners.h>
#include <lacuna/quads/detail/pave_rows.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/row_heights.h>
#include <lacuna/quads/measure_plane.h>
#include <lacuna/quads/submap.h>

#include <array>
#include <sstream>

namespace lacuna::quads {
namespace {

using namespace paving;

std::string place_of(const Vec2& p)
{
    std::ostringstream text;
    text << "(" << p.x() << ", " << p.y() << ")";
    return text.str();
}

double area_of(const std::vector<Vec2>& points, const std::vector<Index>& loop)
{
    double twice = 0;
    const Vec2& origin = points[static_cast<std::size_t>(loop.front())];
    for (std::size_t i = 0; i < loop.size(); ++i)
        twice += cross(points[static_cast<std::size_t>(loop[i])] - origin,
                       points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])] - origin);
    return twice / 2;
}

/// Is a node inside a loop? By the sides a ray from it to the right meets.
bool lies_within(const std::vector<Vec2>& points, const std::vector<Index>& loop, Index node)
{
    const Vec2& p = points[static_cast<std::size_t>(node)];
    bool within = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 &a = points[static_cast<std::size_t>(loop[i])],
                   &b = points[static_cast<std::size_t>(loop[(i + 1) % loop.size()])];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        const bool above = geometry::orient2d(a, b, p) > 0;
        if (above == (b.y() > a.y())) within = !within;
    }
    return within;
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
    for (std::size_t l = 0; l < region.loops.size(); ++l) {
        const auto& loop = region.loops[l];
        const bool outer = l == 0;
        if ((area_of(region.points, loop) > 0) == outer &&
            (outer || lies_within(region.points, region.loops[0], loop.front())))
            continue;
        throw InvalidInput(
            "surface.pave_loops",
            outer
                ? "the outer loop of a region to be paved runs clockwise; the first loop goes round the "
                  "others, with the "
                  "region on its left"
                : "loop " + std::to_string(l + 1) +
                      " of a region to be paved is no hole in loop 1: holes lie inside it and run clockwise");
    }
    if (sides % 2 != 0) {
        throw InvalidInput(
            "surface.pave_parity",
            "a region with " + std::to_string(sides) +
                " boundary sides cannot be filled with quads alone; give one of its edges one side more");
    }
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

/// Other tastes, for regions so small that paving them again costs little. Chosen one after the other from forty so
/// that the best of all is best on average over made-up discs, boxes, Ls and polygons with up to four holes.
constexpr std::array<Taste, 7> kTastes{{
    {.corners = 0.5, .length = 0.5, .mismatch = 0.75, .bent = 0.375, .most_patch = 0.85},
    {.corners = 0.5, .added = 0.5, .length = 0.75, .mismatch = 0.75, .bent = 0.675},
    {.corners = 1.35, .added = 1.35, .mismatch = 0.5, .bent = 0.25, .least_patch = 0.5},
    {.added = 0.5, .length = 0.5, .most_patch = 0.85},
    {.added = 0.5, .length = 0.75, .mismatch = 0.75, .bent = 1, .least_patch = 0.5},
    {.added = 0.5, .length = 1.35, .mismatch = 1.35, .bent = 0.375, .most_patch = 0.85},
    {.added = 1.35, .mismatch = 2, .bent = 1},
}};

/// How good quads are, to choose between two ways; higher is better. A mean of shapes, sizes, rows and the
/// worst quad, less what is irregular. The worst quad counts double up to kGood, for a sweep repeats it and makes
/// it worse, and a little up to kBest. How many irregular nodes there must be hangs on the outline, not on the number of
/// quads: of few quads their share says nothing.
double score_of(const PlanarQuads& mesh, const PlanarRegion& region)
{
    constexpr double kGood = 0.6, kBest = 0.85, kFewNodes = 1500;
    const PlaneQuality quality = measure_plane(mesh, region);
    const double least = quality.min_scaled_jacobian;
    const double irregular = static_cast<double>(quality.irregular) /
                             std::max(static_cast<double>(quality.interior), kFewNodes);
    return quality.mean_scaled_jacobian + 2 * std::min(least, kGood) +
           (std::clamp(least, kGood, kBest) - kGood) / 2 + quality.size_share() / 2 +
           quality.row_share() / 2 - 2 * irregular;
}

/// The grid of a region of right angles, as an attempt like others.
Attempt try_submap(const PlanarRegion& region, bool round_loops, const RunContext& context)
{
    Attempt attempt;
    auto mesh = submap(region, round_loops, context);
    if (!mesh) return attempt;
    attempt.mesh = std::move(*mesh);
    attempt.report.used = attempt.mesh.how;
    attempt.report.mapped = 1;
    correct_row_heights(attempt.mesh, region, size_with_boundary(region));
    judge(attempt);
    return attempt;
}

/// Is a grid so good that nothing else need be tried?
bool is_good_grid(const Attempt& attempt, const PlanarRegion& region)
{
    constexpr double kGood = 0.6, kOfSize = 0.95;
    if (attempt.worst < kGood) return false;
    const PlaneQuality quality = measure_plane(attempt.mesh, region);
    return quality.min_scaled_jacobian > kGood && quality.size_share() > kOfSize;
}

/// Rows of their own height are laid first and stay as they are; what is inside them is a region by itself.
PlanarQuads pave_inside_rows(const PlanarRegion& region, const PaveOptions& options,
                             const RunContext& context)
{
    Draft draft{region.points, {}, region.points.size(), size_with_boundary(region), flat_below(region)};
    std::vector<Cycle> loops = region.loops;
    std::vector<bool> wanted(loops.size(), true);
    int laid = 0;
    std::string missing;
    for (int r = 0; r < std::max(options.rows, 1); ++r) {
        const std::vector<bool> had = wanted;
        const int now = lay_rows(draft, loops, wanted, region.row_height, RowKind::exact);
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (had[l] && !wanted[l])
                missing += ", no room for row " + std::to_string(r + 1) + " along loop " +
                           std::to_string(l + 1);
        }
        if (now == 0) break;
        laid += now;
    }
    PlanarRegion core{{}, {}, region.size, {}};
    std::vector<Index> own;
    for (const Cycle& loop : loops) {
        core.loops.emplace_back();
        for (const Index p : loop) {
            core.loops.back().push_back(static_cast<Index>(own.size()));
            core.points.push_back(draft.at(p));
            own.push_back(p);
        }
    }
    PaveOptions inside = options;
    inside.rows = -1;
    const PlanarQuads filling = pave(core, inside, context);
    PlanarQuads mesh{std::move(draft.points), std::move(draft.quads), filling.how};
    for (std::size_t p = own.size(); p < filling.points.size(); ++p) {
        own.push_back(static_cast<Index>(mesh.points.size()));
        mesh.points.push_back(filling.points[p]);
    }
    for (Quad quad : filling.quads) {
        for (Index& p : quad) p = own[static_cast<std::size_t>(p)];
        mesh.quads.push_back(quad);
    }
    mesh.how += " inside " + std::to_string(laid) +
                (laid == 1 ? " row of its own height" : " rows of their own height") + missing;
    drop_loose_points(mesh, region.points.size());
    if (options.report) options.report->rows += laid;
    return mesh;
}

} // namespace

PlanarQuads pave(const PlanarRegion& region, const PaveOptions& options, const RunContext& context)
{
    check_region(region);
    if (region.row_height && options.rows != 0) return pave_inside_rows(region, options, context);
    // Below this many quads it costs little to pave with and without rows and keep the better.
    constexpr std::size_t kFew = 4000;
    // And so many in all with every taste.
    constexpr std::size_t kMostMade = 30'000, kMostMadePoor = 6000;
    const double flat = flat_below(region);
    Attempt best;
    double best_score = -2;
    std::size_t made_in_all = 0;
    const auto consider = [&](Attempt made) {
        made_in_all += made.mesh.quads.size();
        if (made.worst > 0 && !find_fault(made.mesh, region).empty()) made.worst = -1;
        const double score = made.worst > flat ? score_of(made.mesh, region) : made.worst;
        if (score <= best_score) return;
        best_score = score;
        best = std::move(made);
    };
    const auto attempt = [&](RowStyle style, const Taste& taste = {}) {
        Attempt made = try_pave(region, options, style, taste, flat, context);
        if (made.worst <= flat)
            log_line(context, "quads fold near " + place_of(made.where) + ": paving differently");
        consider(std::move(made));
    };
    if (options.grids && options.rows < 0) consider(try_submap(region, false, context));
    if (is_good_grid(best, region)) {
        if (options.report) *options.report = best.report;
        return std::move(best.mesh);
    }
    const auto is_few = [&] { return options.rows < 0 && best.mesh.quads.size() <= kFew; };
    attempt(RowStyle::by_shape);
    if (best.worst <= flat) attempt(RowStyle::buffer);
    for (const RowStyle style : {RowStyle::no_rows, RowStyle::thin}) {
        if (best.worst <= 0 || is_few()) attempt(style);
    }
    if (options.grids && is_few()) consider(try_submap(region, true, context));
    // A worst quad poorer than this is the outline's doing more than the cuts'.
    constexpr double kPoor = 0.5, kGoodEnough = 3.3; // of 3.325
    for (const Taste& taste : kTastes) {
        const std::size_t most = best.worst > kPoor ? kMostMade : kMostMadePoor;
        if (best.worst > flat && is_few() && made_in_all < most && best_score < kGoodEnough)
            attempt(best.style, taste);
    }
    // Triangles are the last resort, and worth a trial where that costs little.
    if (best.worst <= flat || (is_few() && best.worst < kPoor)) attempt(RowStyle::triangles);
    if (best.worst <= 0) {
        throw NotSweepable("surface.pave", "no valid quads were found for a region of " +
                                               std::to_string(region.points.size()) +
                                               " boundary nodes: near " + place_of(best.where) +
                                               " they fold; try a smaller size there, or quads = \"gmsh\"");
    }
    // Between sides that all but touch, or in spikes, there are none but flat ones.
    if (best.worst <= flat) {
        log_line(context, "the flattest quad, near " + place_of(best.where) + ", has a scaled Jacobian of " +
                              std::to_string(best.worst) +
                              ": the boundary's sides are long for the gap there");
    }
    best.mesh.how = best.report.used;
    if (best.report.refilled > 0)
        best.mesh.how += ", " + std::to_string(best.report.refilled) + " places by split triangles";
    if (options.report) *options.report = best.report;
    return std::move(best.mesh);
}

} // namespace lacuna::quads
