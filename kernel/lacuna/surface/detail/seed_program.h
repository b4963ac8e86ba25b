// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// The integer program for coupled faces. Internal to this folder.
namespace lacuna::surface {

/// Step 2 of `seed_source()`: find the numbers of sides for all mapped and submapped faces, the free faces
/// next to them, and large sectors, by one integer program.
/// @return  edges of free faces whose numbers of sides are those of a grid.
std::set<EdgeId> solve_together(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
                                Seeds& seeds);

/// Step 4 of `seed_source()`: change the numbers of sides as little as possible, so that opposite sides of
/// grids have equal numbers and the total of each free face is even. One program covers all edges. Where
/// given numbers make this impossible, the numbers stay as they are.
/// @param alike    edges that a symmetry of a face maps onto each other. A change of these costs more than a
///         change of other edges.
/// @param settled  edges with the numbers of sides of a grid. A change of these costs more, too.
void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
               const std::set<EdgeId>& settled, Seeds& seeds);

} // namespace lacuna::surface
