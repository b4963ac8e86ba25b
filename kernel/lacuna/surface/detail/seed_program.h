// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// The integer program for coupled faces. Internal to this folder.
namespace lacuna::surface {

/// Numbers of sides for all mapped and submapped faces and the free faces next to them, solved as one
/// program; see `seed_source()`.
/// @return  edges of free faces whose counts are those of a grid.
std::set<EdgeId> solve_together(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
                                Seeds& seeds);

/// Repair the counts with the least change, so that opposite sides of grids are equal and the total of each
/// free face is even. One program covers all edges, as far as given numbers permit.
/// @param alike    edges that a symmetry of a face maps onto each other; they are changed last.
/// @param settled  edges with the counts of a grid; they are changed last too.
void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
               const std::set<EdgeId>& settled, Seeds& seeds);

} // namespace lacuna::surface
