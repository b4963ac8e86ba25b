// SPDX-License-Identifier: MIT
#include <lacuna/quads/submap.h>

#include <lacuna/quads/detail/pave_rows.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/submap_grid.h>
#include <lacuna/quads/measure_plane.h>
#include <lacuna/quads/smooth_plane.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::quads {
namespace {

/// The number of nodes at which a loop turns in the grid.
std::size_t corner_count(const GridLoop& loop)
{
    std::size_t count = 0;
    for (std::size_t i = 0, n = loop.positions.size(); i < n; ++i) {
        const GridPosition &before = loop.positions[(i + n - 1) % n], &here = loop.positions[i],
                           &after = loop.positions[(i + 1) % n];
        count += after[0] - here[0] != here[0] - before[0] || after[1] - here[1] != here[1] - before[1] ? 1U
                                                                                                        : 0U;
    }
    return count;
}

/// Lay a row along every round loop. @return false where one has no room, or its inner side cannot have four
/// corners.
bool lay_rows_on_round(paving::PartialMesh& partial, std::vector<std::vector<Index>>& loops,
                       const std::vector<bool>& round)
{
    std::vector<bool> wanted = round;
    paving::lay_rows(partial, loops, wanted, partial.size);
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (round[l] && (!wanted[l] || loops[l].size() % 2 != 0 || loops[l].size() < 8)) return false;
    }
    return true;
}

/// Give the holes their positions in the outer loop's grid.
/// @return how far their nodes are from the outline's interpolated coordinates, squared, in sum.
double place_holes(const std::vector<Vec2>& points, const std::vector<std::vector<Index>>& loops,
                   const std::vector<bool>& round, std::vector<GridLoop>& grid)
{
    double off = 0;
    for (std::size_t l = 1; l < loops.size(); ++l) {
        std::vector<Vec2> goal;
        for (const Index p : loops[l])
            goal.push_back(mean_value_position(points, grid.front(), points[static_cast<std::size_t>(p)]));
        if (!round[l]) {
            off += place_hole(goal, grid[l]);
            continue;
        }
        // The corners go where they lie nearest to those of a square.
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t start = 0; start < loops[l].size() / 2; ++start) {
            GridLoop turned = with_corners(loops[l], start, false);
            const double error = place_hole(goal, turned);
            if (error >= least) continue;
            least = error;
            grid[l] = std::move(turned);
        }
        off += least;
    }
    return off;
}

/// Grid coordinates of all loops; nothing where one does not close.
std::optional<std::vector<GridLoop>> place_loops(const std::vector<Vec2>& points,
                                                 const std::vector<std::vector<Index>>& loops,
                                                 const std::vector<bool>& round)
{
    std::vector<GridLoop> grid(loops.size());
    for (std::size_t l = 0; l < loops.size(); ++l) {
        if (round[l]) continue;
        auto walked = walk(points, loops[l], l == 0 ? 4 : -4);
        if (!walked) return std::nullopt;
        grid[l] = std::move(*walked);
    }
    if (!round[0]) {
        place_holes(points, loops, round, grid);
        return grid;
    }
    // A round outline may have its corners anywhere: they go where the holes fit best.
    constexpr std::size_t kStarts = 8; // first corners tried in a quarter of the loop, for the time; a choice
    const std::size_t quarter = loops[0].size() / 4;
    std::vector<GridLoop> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < (loops.size() > 1 ? kStarts : 1); ++k) {
        grid[0] = with_corners(loops[0], k * quarter / kStarts, true);
        std::vector<GridLoop> settled = grid;
        const double off = place_holes(points, loops, round, settled);
        if (off >= least) continue;
        least = off;
        best = std::move(settled);
    }
    return best;
}

} // namespace

int grid_quads(double angle)
{
    using paving::kRightAngle;
    constexpr double kOff = kRightAngle * 4 / 9; // 40°: it leaves a sine of 0.77 at a corner; a choice
    const int quads = paving::quads_in(angle);
    // Any angle that is nearest to a straight one is a side: outlines of few nodes bend by up to 45° at each.
    if (quads == 2) return 2;
    return quads <= 4 && std::abs(angle - quads * kRightAngle) <= kOff ? quads : 0;
}

std::optional<PlanarQuads> submap(const PlanarRegion& region, bool round_loops, const RunContext& context)
{
    const std::size_t fixed = region.points.size();
    paving::PartialMesh partial{region.points, {}, fixed, paving::size_with_boundary(region), 0};
    std::vector<std::vector<Index>> loops = region.loops;
    std::vector<bool> round;
    for (const auto& loop : loops) round.push_back(is_round(region.points, loop));
    const bool rows = std::find(round.begin(), round.end(), true) != round.end();
    if (rows && (!round_loops || !lay_rows_on_round(partial, loops, round))) return std::nullopt;
    const auto grid_loops = place_loops(partial.points, loops, round);
    if (!grid_loops) return std::nullopt;
    SubmapGrid grid(*grid_loops);
    if (!grid.enclose(*grid_loops)) return std::nullopt;
    const bool four_sided = !rows && loops.size() == 1 && corner_count(grid_loops->front()) == 4;
    PlanarQuads mesh{std::move(partial.points), std::move(partial.quads),
                     four_sided ? "mapped"
                     : rows     ? "paved, its core submapped"
                                : "submapped"};
    const auto first = static_cast<Index>(mesh.points.size());
    mesh.points.resize(mesh.points.size() + static_cast<std::size_t>(grid.number_inner(first)), Vec2::Zero());
    grid.place_inner(mesh.points, first);
    const std::vector<Quad> cells = grid.quads();
    mesh.quads.insert(mesh.quads.end(), cells.begin(), cells.end());
    smooth_plane(mesh.points, mesh.quads, fixed, {.size = partial.size, .repairs = 0}, context);
    // Poor quads are repaired one by one where they are few: a grid that is poor all over stays so.
    constexpr double kFewPoor = 0.1; // of the quads; a choice, not a measurement
    const SmoothPlaneOptions repairs{.size = partial.size, .sweeps = 0, .untangle = false};
    const auto poor = std::count_if(mesh.quads.begin(), mesh.quads.end(), [&](const Quad& quad) {
        return scaled_jacobian(mesh.points, quad) < repairs.good_enough;
    });
    if (static_cast<double>(poor) <= kFewPoor * static_cast<double>(mesh.quads.size()))
        smooth_plane(mesh.points, mesh.quads, fixed, repairs, context);
    if (!find_fault(mesh, region).empty()) return std::nullopt;
    return mesh;
}

} // namespace lacuna::quads
