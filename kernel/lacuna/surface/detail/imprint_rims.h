// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <span>
#include <vector>

/// The rims of both ends before an imprint. Internal to this folder.
namespace lacuna::surface {

/// A vertex on the source's rim for every one of the target's where an inner edge ends: one that is near, or
/// the rim is split there.
/// @param inner  edges inside the target.
/// @throw NotSweepable "surface.not_imprinted"  the rim cannot be split there.
std::vector<RimPair> pair_rims(topology::Model& model, std::span<const LinkingSurface> links,
                               std::span<const EdgeId> inner, const SizeField& size);

/// The linking surfaces of a volume whose rims were paired; those without a pair are turned as they were.
std::vector<LinkingSurface> link_anew(const topology::OpenVolume& volume,
                                      std::span<const LinkingSurface> given_links,
                                      std::span<const RimPair> pairs);

} // namespace lacuna::surface
