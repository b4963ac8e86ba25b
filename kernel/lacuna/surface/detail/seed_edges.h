// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/seed_task.h>

#include <map>
#include <set>
#include <span>

/// The requested sides of every source edge, before interval assignment. Internal to this folder.
namespace lacuna::surface {

/// Divide all edges into pieces (`SeedPiece`), and give each piece the number of sides that size and
/// curvature require. Two kinds of edges keep their given nodes: edges of faces that keep their own quads,
/// and edges inside the source that have given nodes.
/// @param lengths  as for `seed_source()`.
/// @param kept     faces that keep their own quads, whatever the style.
/// @return  seeds of which only `pieces`, `kept` and `notes` are set.
/// @throw NotSweepable  "surface.given_triangles", "surface.not_kept", "surface.kept_rim",
///                      "surface.too_many_sides".
Seeds ask_edges(const SeedTask& task, std::span<const LinkingSurface> links,
                const std::map<EdgeId, double>& lengths, const std::set<FaceId>& kept = {});

} // namespace lacuna::surface
