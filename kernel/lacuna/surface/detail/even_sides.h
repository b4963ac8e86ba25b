// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// An even number of sides around every free face. Internal to this folder.
namespace lacuna::surface {

/// Make the number of sides even on each edge of free faces with many quads. Such a face is first meshed with
/// a quarter as many quads, over every other rim node, and then refined. Edges of other faces are not
/// changed.
/// @param settled  further edges that are not changed.
void make_halvable(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled,
                   Seeds& seeds);

/// Make the number of sides on the rim of every free face even, because quads cannot fill an odd rim. If all
/// sides of a rim are given, the longest side that no kept quad uses is divided; with wedges, one cell
/// becomes a triangle instead. A note reports the change.
/// @throw NotSweepable "surface.sides_asked", "surface.odd_loop"  no edge can take another side.
void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
