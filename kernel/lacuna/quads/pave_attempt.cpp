// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_attempt.h>

#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/detail/clean_quads.h>
#include <lacuna/quads/detail/open_corners.h>
#include <lacuna/quads/detail/pave_core.h>
#include <lacuna/quads/detail/pave_rows.h>
#include <lacuna/quads/detail/raise_flat_quads.h>
#include <lacuna/quads/detail/row_heights.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/detail/triangle_quads.h>

namespace lacuna::quads::paving {
namespace {

/// Number of rows to pave along a loop. Inside the rows along a round outer loop, a square remains with a
/// node of three quads at each corner. With one row for about sixty nodes of the loop, the square has as many
/// boundary nodes as the loop. Around a hole, each further row only adds stretched quads.
int rows_for(const PartialMesh& partial, const Cycle& loop, bool outer)
{
    if (!needs_row(partial, loop)) return 0;
    constexpr std::size_t kNodesARow = 60;
    return outer ? 1 + static_cast<int>(loop.size() / kNodesARow) : 1;
}

/// Whether every edge is used at most once in each direction.
bool is_conforming(const PlanarQuads& mesh)
{
    const auto opposite = mesh::opposite_sides(mesh.quads, static_cast<Index>(mesh.points.size()));
    return std::ranges::find(opposite, mesh::kBadSide) == opposite.end();
}

/// Open folded quads, first by moving nodes and then by adding nodes (pillows).
void open_folds(Attempt& attempt, const AttemptSetting& setting, const RunContext& context)
{
    const std::size_t fixed = setting.region.points.size();
    for (int round = 0; round < 2; ++round) {
        Attempt tried = attempt;
        if (round > 0) pillow_folds(tried.mesh, setting.flat);
        raise_flat_quads(tried.mesh, fixed);
        judge(tried);
        if (tried.worst <= setting.flat && round == 0) {
            clean_quads(tried.mesh, fixed, {.size = setting.size}, context);
            raise_flat_quads(tried.mesh, fixed);
            judge(tried);
        }
        if (tried.worst <= setting.flat) {
            // Only untangle here, because the opened quads are smoothed with all others later.
            smooth_plane(tried.mesh.points, tried.mesh.quads, fixed,
                         {.size = setting.size, .sweeps = 0, .repairs = 0}, context);
            judge(tried);
        }
        const bool better = round == 0 || tried.worst > attempt.worst;
        if (better) attempt = std::move(tried);
        if (!better || attempt.worst > setting.flat) break;
    }
}

void clean_and_smooth(Attempt& attempt, const AttemptSetting& setting, bool thorough,
                      const RunContext& context)
{
    const std::size_t fixed = setting.region.points.size();
    clean_quads(attempt.mesh, fixed, {.size = setting.size, .thorough = thorough}, context);
    smooth_plane(attempt.mesh.points, attempt.mesh.quads, fixed, {.size = setting.size}, context);
    correct_row_heights(attempt.mesh, setting.region, setting.size);
    judge(attempt);
}

/// Pave rows along the loops, then cut and fill the rest.
void pave_and_fill(Attempt& attempt, PartialMesh& partial, const PlanarRegion& region, RowStyle style,
                   const RunContext& context)
{
    std::vector<Cycle> loops = region.loops;
    std::vector<int> rows;
    for (std::size_t l = 0; l < loops.size(); ++l) {
        const int own = rows_for(partial, loops[l], l == 0);
        rows.push_back(style == RowStyle::no_rows ? 0 : own);
    }
    int laid = 0;
    for (int r = 0;; ++r) {
        std::vector<bool> wanted;
        for (const int own : rows) wanted.push_back(own > r);
        if (std::ranges::none_of(wanted, [](bool w) { return w; })) break;
        laid += lay_rows(partial, loops, wanted, partial.size, RowKind::tall);
        for (std::size_t l = 0; l < loops.size(); ++l) {
            if (!wanted[l]) rows[l] = 0;
        }
    }
    const std::optional<bool> is_one_patch = fill_core(partial, loops, context);
    if (!is_one_patch) return; // another attempt fills the region, at last the one of triangles
    attempt.report.used = *is_one_patch && laid == 0 ? "mapped" : "paved";
    attempt.mesh = {partial.points, partial.quads};
    drop_loose_points(attempt.mesh, partial.fixed);
}

} // namespace

void judge(Attempt& attempt)
{
    attempt.worst = 1;
    for (const Quad& q : attempt.mesh.quads) {
        const auto at = [&](std::size_t k) { return attempt.mesh.points[index(q[k])]; };
        const double sine = least_sine(at(0), at(1), at(2), at(3));
        if (sine >= attempt.worst) continue;
        attempt.worst = sine;
        attempt.where = (at(0) + at(1) + at(2) + at(3)) / 4;
    }
}

Attempt begin_attempt(const AttemptSetting& setting, RowStyle style, const CutWeights& weights,
                      const RunContext& context)
{
    const PlanarRegion& region = setting.region;
    Attempt attempt;
    attempt.style = style;
    if (style == RowStyle::triangles) {
        attempt.mesh = quads_of_triangles(region);
        attempt.report.used = "triangles";
    } else {
        PartialMesh partial{region.points, {}, region.points.size(), setting.size, setting.flat, {}, weights};
        pave_and_fill(attempt, partial, region, style, context);
    }
    if (attempt.mesh.quads.empty() || !is_conforming(attempt.mesh)) return attempt;
    if (style != RowStyle::triangles) open_corners(attempt.mesh, region);
    judge(attempt);
    return attempt;
}

void finish_attempt(Attempt& attempt, const AttemptSetting& setting, bool thorough, const RunContext& context)
{
    if (attempt.worst < -1) return; // there are no quads, or they do not conform
    open_folds(attempt, setting, context);
    if (attempt.worst > 0) clean_and_smooth(attempt, setting, thorough, context);
}

} // namespace lacuna::quads::paving
