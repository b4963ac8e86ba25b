// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/criteria.h>
#include <lacuna/surface/shared/edge_nodes.h>

#include <algorithm>
#include <span>
#include <vector>

namespace lacuna::surface {

/// A point of the model on a chain.
struct ChainNode {
    double at = 0; ///< running length [model length]
    Index point = -1;
};

/// Points of a closed chain in order, without those on edges for which `wanted` is false.
template <class Wanted>
std::vector<ChainNode> chain_nodes(const topology::Model& model, const Chain& chain, const Wanted& wanted)
{
    std::vector<ChainNode> nodes;
    for (std::size_t u = 0; u < chain.uses().size(); ++u) {
        if (!wanted(chain.uses()[u].edge)) continue;
        const std::vector<Index> points = topology::use_points(model, chain.uses()[u]);
        double at = chain.start(u);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            nodes.push_back({at, points[i]});
            at += (model.at(points[i + 1]) - model.at(points[i])).norm();
        }
    }
    return nodes;
}

/// The index of the node at a running length of a closed chain, within rounding; -1 if there is none.
inline Index node_at(std::span<const ChainNode> nodes, const Chain& chain, double place)
{
    const double slack = kSamePlace * chain.length();
    if (place >= chain.length() - slack) place -= chain.length();
    const auto next = std::ranges::lower_bound(nodes, place - slack, {}, &ChainNode::at);
    return next != nodes.end() && next->at <= place + slack ? static_cast<Index>(next - nodes.begin()) : -1;
}

/// Points of a closed chain in order.
inline std::vector<ChainNode> chain_nodes(const topology::Model& model, const Chain& chain)
{
    return chain_nodes(model, chain, [](EdgeId) { return true; });
}

} // namespace lacuna::surface
