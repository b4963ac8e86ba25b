// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/split_edge.h>

#include <span>
#include <vector>

/// The rims of both ends before an imprint. Internal to this folder.
namespace lacuna::surface {

/// Find a vertex of the source's rim for every vertex of the target's rim at which an inner edge ends: an
/// existing vertex nearby, or a new vertex that splits an edge of the source's rim.
/// @param inner  edges inside the target.
/// @throw NotSweepable "surface.not_imprinted"  the rim cannot be split there.
std::vector<RimPair> pair_rims(topology::Model& model, std::span<const LinkingSurface> links,
                               std::span<const EdgeId> inner, const SizeField& size);

/// Split an edge. @param because  the inner edge of the target that requires it
/// @throw NotSweepable "surface.not_imprinted"  the edge cannot be split there.
topology::EdgeSplit split_at(topology::Model& model, EdgeId edge, double fraction, EdgeId because);

/// The linking surfaces of a volume whose rims have paired vertices. A linking surface without such a pair
/// keeps the rotation that it has in `given_links`.
std::vector<LinkingSurface> link_anew(const topology::OpenVolume& volume,
                                      std::span<const LinkingSurface> given_links,
                                      std::span<const RimPair> pairs);

} // namespace lacuna::surface
