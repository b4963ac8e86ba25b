// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// An even number of sides around every free face. Internal to this folder.
namespace lacuna::surface {

/// For free faces with many quads, make the number of sides even on each of their edges. Such a face is first
/// meshed with a quarter as many quads, using every other rim node, and then refined. Edges that also belong
/// to other faces are not changed.
/// @param settled  further edges that are not changed.
void make_halvable(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled,
                   Seeds& seeds);

/// Make the number of sides on the rim of every free face even, because quads cannot fill an odd rim. If all
/// sides of an odd rim are given, the longest side that no kept quad uses is divided, or, with wedges, one
/// cell becomes a triangle. A note reports either change.
/// @throw NotSweepable "surface.sides_asked", "surface.odd_loop"  no edge can take another side.
void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
