// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// An even number of sides around every free face. Internal to this folder.
namespace lacuna::surface {

/// For free faces with many quads, make the number of sides on each of their edges even. Such a face is first
/// meshed with a quarter of the quads, using every other rim node; then each quad is divided into four. Edges
/// that also belong to other faces are not changed.
/// @param settled  further edges that are not changed.
void make_halvable(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled,
                   Seeds& seeds);

/// Make the total number of sides around every free face even, because quads cannot fill a face with an odd
/// total. This is the last step, for faces whose given numbers `make_even()` could not change: the longest
/// side on the rim that belongs to this face only is divided or, with wedges, one cell of the face becomes a
/// triangle. Numbers that the user requested are not changed. A note reports either change.
/// @throw NotSweepable "surface.sides_asked", "surface.odd_loop"  no edge can take another side.
void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
