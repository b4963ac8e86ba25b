// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/imprint_map.h>

#include <span>
#include <vector>

/// Closed edges of both ends that are swept to each other. Internal to this folder.
namespace lacuna::surface {

/// Smooth closed edges that meet no other edge and enclose about the same in the plane of a map, the most
/// alike first; each edge is in one pair at most, and turned to the other as little as can be.
std::vector<ClosedPair> alike_closed_edges(const topology::Model& model, const EndsMap& map,
                                           std::span<const EdgeId> source, std::span<const EdgeId> target);

} // namespace lacuna::surface
