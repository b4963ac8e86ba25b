// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// The integer program for coupled faces. Internal to this folder.
namespace lacuna::surface {

/// Find the numbers of sides for all mapped and submapped faces, and the free faces next to them, by one
/// program; see `seed_source()`.
/// @return  edges of free faces whose numbers of sides are those of a grid.
std::set<EdgeId> solve_together(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
                                Seeds& seeds);

/// Change the numbers of sides as little as possible, so that opposite sides of grids have equal numbers and
/// the total of each free face is even. One program covers all edges. Where given numbers make this
/// impossible, the numbers stay as they are.
/// @param alike    edges that a symmetry of a face maps onto each other; these are changed last.
/// @param settled  edges with the numbers of sides of a grid; these are also changed last.
void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
               const std::set<EdgeId>& settled, Seeds& seeds);

} // namespace lacuna::surface
