// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/seed_task.h>

#include <map>
#include <set>
#include <span>

/// The requested sides of every source edge, before interval assignment. Internal to this folder.
namespace lacuna::surface {

/// The pieces of all edges, with the numbers of sides that size and curvature require. Kept are the nodes of
/// faces that keep their own quads, and nodes given on edges inside the source.
/// @param lengths  as for `seed_source()`.
/// @param kept     faces that keep their own quads in any style.
/// @return  seeds of which only `pieces`, `kept` and `notes` are set.
/// @throw NotSweepable  "surface.given_triangles", "surface.not_kept", "surface.kept_rim",
///                      "surface.too_many_sides".
Seeds ask_edges(const SeedTask& task, std::span<const LinkingSurface> links,
                const std::map<EdgeId, double>& lengths, const std::set<FaceId>& kept = {});

} // namespace lacuna::surface
