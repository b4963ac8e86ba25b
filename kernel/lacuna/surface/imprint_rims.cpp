// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/imprint_rims.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/attempt.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/matching/shared/corners.h>
#include <lacuna/surface/detail/imprint_rules.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/topology/shared/split_edge.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Whether a vertex of the source's rim already corresponds to a corner of the target's rim, or to the end of
/// a side line.
bool is_taken(const Model& model, const LinkingSurface& link, double source_at)
{
    const double slack = kSamePlace * link.source.length();
    for (const LinkingLine& line : link.lines) {
        if (std::abs(line.source_at - source_at) <= slack) return true;
    }
    for (const RimSegment& segment : link.segments) {
        if (std::abs(segment.source_from - source_at) > slack) continue;
        for (std::size_t i = 0; i < link.target.uses().size(); ++i) {
            double off = std::abs(segment.target_from - link.target.start(i));
            off = std::min(off, std::abs(off - link.target.length()));
            if (off <= kSamePlace * link.target.length() && matching::is_corner(model, link.target.uses(), i))
                return true;
        }
    }
    return false;
}

/// The inner edge of the target that ends at a vertex.
EdgeId inner_at(const Model& model, std::span<const EdgeId> inner, VertexId vertex)
{
    for (const EdgeId edge : inner) {
        if (model[edge].from == vertex || model[edge].to == vertex) return edge;
    }
    return inner.front();
}

} // namespace

EdgeSplit split_at(Model& model, EdgeId edge, double fraction, EdgeId because)
{
    auto split = attempt<InvalidInput>([&] { return split_edge(model, edge, fraction); });
    if (split) return std::move(*split);
    throw NotSweepable(Message("surface.not_imprinted",
                               "{} lies inside one end and cannot be imprinted on the other: {} cannot be "
                               "split there",
                               entity_of(model, because), entity_of(model, edge))
                           .remedy("choose other faces as source and target")
                           .attempt(*split.why));
}

std::vector<RimPair> pair_rims(Model& model, std::span<const LinkingSurface> links,
                               std::span<const EdgeId> inner, const SizeField& size)
{
    std::vector<RimPair> pairs;
    std::set<VertexId> ends;
    for (const EdgeId edge : inner) ends.insert({model[edge].from, model[edge].to});
    struct Split {
        double fraction;
        VertexId target;
    };
    std::map<EdgeId, std::vector<Split>> splits;
    const Model& before = model;
    for (const LinkingSurface& link : links) {
        std::set<std::size_t> used;
        for (std::size_t i = 0; i < link.target.uses().size(); ++i) {
            const VertexId vertex = use_from(before, link.target.uses()[i]);
            if (!ends.contains(vertex)) continue;
            const double at = target_coordinate(link, link.target.start(i)) * link.source.length();
            const double exact = std::max(kSamePlace * link.source.length(), before.tolerance);
            std::optional<std::size_t> near;
            double least = kInfinity;
            for (std::size_t u = 0; u < link.source.uses().size(); ++u) {
                double off = std::abs(link.source.start(u) - at);
                off = std::min(off, std::abs(off - link.source.length()));
                const VertexId there = use_from(before, link.source.uses()[u]);
                const double reach = kOneEdge * size(before.at(before[there].point));
                const bool free = !used.contains(u) && !is_taken(before, link, link.source.start(u));
                if (off < least && (off <= exact || (free && off <= reach))) {
                    near = u;
                    least = off;
                }
            }
            if (near) {
                used.insert(*near);
                pairs.push_back({use_from(before, link.source.uses()[*near]), vertex});
                continue;
            }
            const ChainPosition place = link.source.position(at);
            splits[link.source.uses()[place.use].edge].push_back({place.fraction, vertex});
        }
    }
    for (auto& [edge, list] : splits) {
        std::ranges::sort(list, std::ranges::greater{}, &Split::fraction);
        double end = 1; // end of the part of the original edge that is not split yet; the part starts at 0
        for (const Split& split : list) {
            pairs.push_back(
                {split_at(model, edge, split.fraction / end, inner_at(model, inner, split.target)).vertex,
                 split.target});
            end = split.fraction;
        }
    }
    return pairs;
}

std::vector<LinkingSurface> link_anew(const OpenVolume& volume, std::span<const LinkingSurface> given_links,
                                      std::span<const RimPair> pairs)
{
    std::vector<LinkingSurface> links = linking_surfaces(volume, Turning::each, pairs);
    for (std::size_t b = 0; b < links.size(); ++b) {
        LinkingSurface& link = links[b];
        const LinkingSurface& given = given_links[b];
        if (link.source.uses() != given.source.uses() || link.target.uses() != given.target.uses()) continue;
        const bool paired = std::ranges::any_of(pairs, [&](const RimPair& pair) {
            return std::ranges::any_of(link.source.uses(), [&](const EdgeUse& use) {
                return use_from(volume.model, use) == pair.source;
            });
        });
        if (paired) continue;
        link.segments = given.segments; // keep the given rotation
        link.branch = given.branch;
    }
    return links;
}

} // namespace lacuna::surface
