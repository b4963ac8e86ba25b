// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/seed_task.h>

#include <map>
#include <set>
#include <span>

/// What every edge of the source is asked for, before edges are made to agree. Internal to this folder.
namespace lacuna::surface {

/// The pieces of all edges with the sides that size and curvature ask for, and with the nodes that are kept:
/// those of faces whose own quads are the mesh, and those given on edges inside the source.
/// @param lengths  as for `seed_source()`.
/// @param kept     faces whose own quads are the mesh whatever the style.
/// @return  with `pieces`, `kept` and `notes`.
/// @throw NotSweepable  "surface.given_triangles", "surface.not_kept", "surface.kept_rim",
///                      "surface.too_many_sides".
Seeds ask_edges(const SeedTask& task, std::span<const LinkingSurface> links,
                const std::map<EdgeId, double>& lengths, const std::set<FaceId>& kept = {});

} // namespace lacuna::surface
