// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/pave_core.h>

#include <lacuna/quads/detail/pave_bridge.h>
#include <lacuna/quads/detail/pave_cut.h>
#include <lacuna/quads/detail/pave_fit.h>
#include <lacuna/quads/detail/pave_patch.h>

namespace lacuna::quads::paving {
std::optional<bool> fill_core(PartialMesh& partial, const std::vector<Cycle>& loops,
                              const RunContext& context)
{
    bool is_one_patch = false;
    for_sides_of(loops, [&](Index a, Index b) { partial.link(a, b); });
    std::optional<Cycle> joined = join_loops(partial, loops);
    if (!joined) return std::nullopt;
    std::vector<Cycle> parts{std::move(*joined)};
    for (bool is_whole = true; !parts.empty(); is_whole = false) {
        check_cancelled(context);
        const Cycle cycle = std::move(parts.back());
        parts.pop_back();
        if (cycle.size() < 4) continue;
        if (cycle.size() <= 6) {
            fill_small(partial, cycle);
            continue;
        }
        const std::vector<double> angles = corner_angles(partial.points, cycle);
        const PatchFit fit = fit_patch(partial, cycle, angles);
        std::optional<Cut> cut;
        if (fit.quality < partial.weights.least_patch) cut = best_cut(partial, cycle, angles);
        if (!cut && fit.quality > 0 && fill_patch(partial, cycle, fit.corners)) {
            is_one_patch = is_whole;
            continue;
        }
        if (!cut) return std::nullopt;
        const Cycle line = nodes_along(partial, cycle[cut->from], cycle[cut->to], cut->edges);
        if (cut->edges == 1) partial.link(line.front(), line.back());
        auto [one, two] = divide(cycle, *cut, line);
        parts.push_back(std::move(two));
        parts.push_back(std::move(one));
    }
    return is_one_patch;
}

} // namespace lacuna::quads::paving
