// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/imprint_map.h>

#include <span>
#include <vector>

/// Closed edges of both ends that are swept to each other. Internal to this folder.
namespace lacuna::surface {

/// Pairs of smooth closed edges, one of each end, that enclose about the same region in the plane of a map
/// and meet no other edge. The most similar pairs come first. Each edge is in at most one pair. The start
/// points of a pair correspond by the smallest rotation.
std::vector<ClosedPair> alike_closed_edges(const topology::Model& model, const EndsMap& map,
                                           std::span<const EdgeId> source, std::span<const EdgeId> target);

} // namespace lacuna::surface
