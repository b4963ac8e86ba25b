// SPDX-License-Identifier: MIT
#include <lacuna/surface/pave_core.h>

#include <lacuna/surface/pave_cut.h>
#include <lacuna/surface/pave_fit.h>
#include <lacuna/surface/pave_patch.h>

namespace lacuna::surface::paving {
namespace {

/// One loop of all, the nearest joined first.
Cycle join_all(Draft& draft, std::vector<Cycle> loops)
{
    while (loops.size() > 1) {
        std::optional<Bridge> best;
        for (std::size_t a = 0; a < loops.size(); ++a) {
            for (std::size_t b = a + 1; b < loops.size(); ++b) {
                const auto bridge = best_bridge(draft, loops, a, b);
                if (bridge && (!best || bridge->cost < best->cost)) best = bridge;
            }
        }
        if (!best) best = blind_bridge(draft, loops);
        const Cycle line = nodes_along(draft, loops[best->loop_a][best->cut.from],
                                       loops[best->loop_b][best->cut.to], best->cut.edges);
        if (best->cut.edges == 1) draft.link(line.front(), line.back());
        loops[best->loop_a] = join(loops[best->loop_a], loops[best->loop_b], best->cut, line);
        loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(best->loop_b));
    }
    return std::move(loops.front());
}

/// From what quality on a part of so many nodes is filled as it is. A cut costs irregular nodes, whatever the
/// size of the part; a poor patch costs in every quad.
double good_patch(const Taste& taste, std::size_t nodes)
{
    constexpr double kSlope = 0.2, kFrom = 32;
    return std::clamp(taste.least_patch + kSlope * std::log2(static_cast<double>(nodes) / kFrom),
                      taste.least_patch, taste.most_patch);
}

} // namespace

CoreCount fill_core(Draft& draft, const std::vector<Cycle>& loops, bool one_patch, const RunContext& context)
{
    CoreCount count;
    for (const Cycle& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) draft.link(loop[i], loop[(i + 1) % loop.size()]);
    }
    std::vector<Cycle> parts{join_all(draft, loops)};
    while (!parts.empty()) {
        check_cancelled(context);
        const Cycle cycle = std::move(parts.back());
        parts.pop_back();
        if (cycle.size() < 4) continue;
        if (cycle.size() <= 6) {
            fill_small(draft, cycle);
            ++count.templates;
            continue;
        }
        const std::vector<double> angles = angles_of(draft, cycle);
        const Fit fit = fit_patch(draft, cycle, angles);
        std::optional<Cut> cut;
        if (!one_patch && fit.quality < good_patch(draft.taste, cycle.size()))
            cut = best_cut(draft, cycle, angles);
        if (!cut && fit.quality > 0 && fill_patch(draft, cycle, fit.corners)) {
            ++count.patches;
            continue;
        }
        if (!cut) cut = blind_cut(draft, cycle);
        const Cycle line = nodes_along(draft, cycle[cut->from], cycle[cut->to], cut->edges);
        if (cut->edges == 1) draft.link(line.front(), line.back());
        auto [one, two] = divide(cycle, *cut, line);
        ++count.cuts;
        parts.push_back(std::move(two));
        parts.push_back(std::move(one));
    }
    return count;
}

} // namespace lacuna::surface::paving
