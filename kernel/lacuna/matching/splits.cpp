// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/splits.h>

#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace lacuna::matching {

using namespace topology;

namespace {

/// In all loops, replace a split edge by its two parts.
void go_on(std::vector<Rim>& rims, EdgeId edge, EdgeId behind)
{
    for (Rim& rim : rims) {
        for (std::size_t i = 0; i < rim.uses.size(); ++i) {
            if (rim.uses[i].edge != edge) continue;
            const bool reversed = rim.uses[i].reversed;
            rim.uses.insert(rim.uses.begin() + static_cast<std::ptrdiff_t>(reversed ? i : i + 1),
                            {behind, reversed});
            ++i;
        }
    }
}

/// Sort the vertex pairs and their `hard` flags in the order of the source's loops.
void sort_pairs(const Model& model, Match& match)
{
    std::map<VertexId, std::size_t> place;
    for (const Rim& rim : match.source_loops) {
        for (const EdgeUse& use : rim.uses) place.try_emplace(use_from(model, use), place.size());
    }
    std::vector<std::size_t> order(match.vertices.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return place[match.vertices[i].first]; });
    Match sorted;
    for (const std::size_t i : order) {
        sorted.vertices.push_back(match.vertices[i]);
        sorted.hard.push_back(match.hard[i]);
    }
    match.vertices = std::move(sorted.vertices);
    match.hard = std::move(sorted.hard);
}

/// True running length on a loop for a running length of its `LoopShape`, which may be measured in sides.
double length_at(const LoopShape& shape, double place)
{
    if (!shape.by_sides) return place;
    const std::vector<double> length = geometry::arc_lengths(shape.points);
    const double at = place / shape.length * static_cast<double>(length.size() - 1);
    const auto side = std::min(static_cast<std::size_t>(at), length.size() - 2);
    return length[side] + (at - static_cast<double>(side)) * (length[side + 1] - length[side]);
}

} // namespace

Split split_at(VertexId vertex, bool on_target, const Rim& rim, const LoopShape& shape, double share)
{
    const double wanted = share * shape.length;
    std::size_t i = rim.uses.size() - 1;
    while (i > 0 && shape.vertex_arc[i] > wanted) --i;
    const double end = i + 1 < shape.vertex_arc.size() ? shape.vertex_arc[i + 1] : shape.length;
    const double from = length_at(shape, shape.vertex_arc[i]);
    const double along = std::clamp((length_at(shape, wanted) - from) / (length_at(shape, end) - from), 0.0,
                                    1.0);
    return {vertex, on_target, rim.uses[i].edge, rim.uses[i].reversed ? 1 - along : along};
}

Matched apply_splits(OpenVolume volume, Match match)
{
    if (match.splits.empty()) return {std::move(volume), std::move(match)};
    Model& model = volume.model;
    // If an edge is split several times, the split nearest to its end comes first: the part before a split
    // keeps the edge's id, so that it can be split again.
    std::vector<Split> splits = std::exchange(match.splits, {});
    std::ranges::stable_sort(splits, std::greater{}, &Split::fraction);
    std::map<EdgeId, double> length;
    for (const Split& split : splits) length.try_emplace(split.edge, edge_length(model, split.edge));
    for (const Split& split : splits) {
        const double wanted = split.fraction * length[split.edge];
        const std::span<const FaceUse> uses = model.uses_of_edge(split.edge);
        const bool on_wall = uses.size() != 1;
        // An edge with given nodes is split at a node, so the part before an earlier split may not have the
        // planned length.
        const double in_front = edge_length(model, split.edge);
        const bool at_end = std::min(wanted, in_front - wanted) <= model.tolerance;
        const bool no_node = model[split.edge].points.size() == 2 &&
                             std::ranges::any_of(uses, [&](const FaceUse& use) {
                                 return !model[use.face].given_quads.empty();
                             });
        if (on_wall || at_end || no_node) {
            match.notes.push_back({"matching.no_partner",
                                   "{} has no partner: its place on the other end is on {}, {}",
                                   entity_of(model, split.vertex), entity_of(model, split.edge),
                                   on_wall  ? "which has a wall"
                                   : at_end ? "at an end that has another partner"
                                            : "inside a quad side of a given mesh"});
            continue;
        }
        const EdgeSplit made = split_edge(model, split.edge, wanted / in_front);
        go_on(split.on_target ? match.target_loops : match.source_loops, split.edge, made.behind);
        match.vertices.emplace_back(split.on_target ? split.vertex : made.vertex,
                                    split.on_target ? made.vertex : split.vertex);
        match.hard.push_back(false);
    }
    sort_pairs(model, match);
    return {std::move(volume), std::move(match)};
}

} // namespace lacuna::matching
