// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/imprint_map.h>

#include <span>
#include <vector>

/// Closed edges of both ends that are swept to each other. Internal to this folder.
namespace lacuna::surface {

/// Pairs of smooth closed edges, one of each end, that enclose about the same region in the plane of `map`.
/// Edges that meet other edges are left out, and each edge is in at most one pair. The most similar pairs
/// come first. Points at equal distances along both edges correspond, counted from the start of the source
/// edge (share 0) and from the share `ClosedPair::from` of the target edge. This share is chosen so that the
/// directions from the centres to corresponding points differ as little as possible.
std::vector<ClosedPair> alike_closed_edges(const topology::Model& model, const EndsMap& map,
                                           std::span<const EdgeId> source, std::span<const EdgeId> target);

} // namespace lacuna::surface
