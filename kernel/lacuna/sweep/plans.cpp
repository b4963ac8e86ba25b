// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/plans.h>

#include <lacuna/core/message.h>
#include <lacuna/surface/shared/imprint.h>

#include <algorithm>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Whether the source keeps its given quads.
bool keeps_quads(const OpenVolume& volume, const SweepOptions& options)
{
    if (options.quads == Quads::keep) return true;
    const std::vector<FaceId> source = volume.faces(Role::source);
    const bool any = options.quads == Quads::automatic && options.rows == 0;
    return std::ranges::any_of(source, [&](FaceId face) {
        const Face& f = volume.model[face];
        return (any || options.beside.handed.contains(face)) &&
               (!f.given_quads.empty() || has_cells_to_keep(f, options.wedges));
    });
}

/// Whether the quads can be laid out in the mean outline of both ends. This requires that the source is
/// paved, that there are no rows or boundary layers, and that each end has one face.
bool can_lie_between(const OpenVolume& volume, const SweepOptions& options)
{
    return (options.quads == Quads::automatic || options.quads == Quads::paved) && options.rows == 0 &&
           options.boundary_layers.empty() && volume.faces(Role::source).size() == 1 &&
           volume.faces(Role::target).size() == 1;
}

/// Whether some loop has walls that do not determine its rotation between the ends, and other loops may
/// determine it.
bool can_turn_together(const std::vector<surface::LinkingSurface>& links)
{
    return links.size() > 1 &&
           std::ranges::any_of(links, [](const surface::LinkingSurface& link) { return link.lines.empty(); });
}

/// The end that a volume is swept from, as the user named it.
std::string end_of(const OpenVolume& volume, bool turned)
{
    return turned != volume.turned_round ? "target" : "source";
}

/// Directions and layouts, best first.
std::vector<Plan> layouts(const OpenVolume& volume, const SweepOptions& options, KnownLinks& links,
                          const RunContext& context)
{
    std::vector<Plan> plans;
    if (keeps_quads(volume, options)) {
        plans.push_back({.keeps_end = true});
        // Rows along walls cannot end on the rim of a neighbour's quads at the source, but they can at the
        // target, so the sweep may also start at the other end.
        if (!options.boundary_layers.empty() && !options.beside.own_mesh) plans.push_back({.turned = true});
        return plans;
    }
    const std::string source = end_of(volume, false), target = end_of(volume, true);
    const bool kept = keeps_quads(links.turned(), options);
    if (kept)
        plans.push_back(
            {.turned = true,
             .keeps_end = true,
             .why = formatted("swept from the {}, which came with quads; the {} did not", target, source)});
    const bool turned = !kept && lies_on_target(volume, options);
    Plan first{.turned = turned};
    if (turned)
        first.why = formatted("swept from the {}, whose faces meet in edges; the {} is one face", target,
                              source);
    plans.push_back(first);
    if (can_turn_together(links.of(volume, context)))
        plans.push_back({.turned = turned,
                         .turning = surface::Turning::together,
                         .below = options.improving.good_enough});
    if (!kept) plans.push_back({.turned = !turned});
    if (can_lie_between(volume, options))
        for (const bool way : {turned, !turned}) plans.push_back({.turned = way, .outline = Outline::mean});
    return plans;
}

} // namespace

bool lies_on_target(const OpenVolume& volume, const SweepOptions& options)
{
    return options.rows == 0 && !surface::inner_edges(volume, Role::target).empty() &&
           surface::inner_edges(volume, Role::source).empty();
}

std::vector<Plan> plans(const OpenVolume& volume, const SweepOptions& asked, KnownLinks& links,
                        const RunContext& context)
{
    std::vector<Plan> all;
    SweepOptions options = asked;
    for (const bool wedges : {false, true}) {
        if (wedges ? !asked.wedges && asked.fallback != Fallback::wedges : asked.wedges) continue;
        options.wedges = wedges;
        for (Plan plan : layouts(volume, options, links, context)) {
            plan.per_turn = options.curvature;
            plan.wedges = wedges;
            all.push_back(std::move(plan));
        }
    }
    return all;
}

std::string in_words(const Plan& plan, const OpenVolume& volume)
{
    std::string words = formatted("swept from the {}", end_of(volume, plan.turned));
    if (plan.outline == Outline::mean) words += ", laid out between the outlines of both ends";
    if (plan.turning == surface::Turning::together) words += ", its loops rotated together";
    if (plan.wedges) words += ", with wedges";
    return words + formatted(", {} sides for a full turn", plan.per_turn);
}

} // namespace lacuna::sweep
