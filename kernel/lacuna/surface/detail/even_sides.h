// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// An even number of sides around every free face. Internal to this folder.
namespace lacuna::surface {

/// Even counts on edges of free faces that get so many quads that these are refined from a mesh with a
/// quarter as many, over every other node. Edges of other faces are not changed.
/// @param settled  edges that are not changed either.
void make_halvable(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled,
                   Seeds& seeds);

/// Quads cannot fill a rim with an odd number of sides. If all are given, the longest side on the rim without
/// kept quads is divided, or with wedges one cell is a triangle; a note says so.
/// @throw NotSweepable  "surface.sides_asked", "surface.odd_loop"  if no edge can take another side.
void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
