// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/submap.h>

#include <lacuna/quads/detail/partial_mesh.h>
#include <lacuna/quads/detail/pave_size.h>
#include <lacuna/quads/detail/smooth_plane.h>
#include <lacuna/quads/detail/submap_grid.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <algorithm>
#include <cmath>

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

} // namespace

int grid_quads(double angle) { return static_cast<int>(std::lround(angle / kRightAngle)); }

std::optional<PlanarQuads> submap(const PlanarRegion& region, const RunContext& context)
{
    const std::size_t fixed = region.points.size();
    std::vector<GridLoop> loops;
    for (const auto& loop : region.loops) {
        auto walked = walk(region.points, loop, loops.empty() ? 4 : -4);
        if (!walked) return std::nullopt;
        loops.push_back(std::move(*walked));
    }
    for (std::size_t l = 1; l < loops.size(); ++l) {
        std::vector<Vec2> goal;
        for (const Index p : loops[l].nodes) {
            goal.push_back(mean_value_position(region.points, loops[0], region.points[index(p)]));
        }
        place_hole(goal, loops[l]);
    }
    SubmapGrid grid(loops);
    if (!grid.enclose(loops)) return std::nullopt;
    const bool four_sided = loops.size() == 1 && corner_count(loops.front()) == 4;
    PlanarQuads mesh{region.points, {}, four_sided ? "mapped" : "submapped"};
    grid.add_cells(mesh);
    const auto size = paving::sizes_with_boundary(region).usual;
    smooth_plane(mesh.points, mesh.quads, fixed, {.size = size, .repairs = 0}, context);
    smooth_plane(mesh.points, mesh.quads, fixed, {.size = size, .sweeps = 0, .untangle = false}, context);
    if (!find_fault(mesh, region).empty()) return std::nullopt;
    return mesh;
}

} // namespace lacuna::quads
