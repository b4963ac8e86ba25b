// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// An even number of sides round every free face. Internal to this folder.
namespace lacuna::surface {

/// Even numbers of sides on edges of free faces that get so many quads that these are made of a quarter as
/// many, over every other node. Edges of other faces keep theirs.
/// @param settled  edges that do so as well.
void make_halvable(const SeedTask& task, const FaceGrids& grids, const std::set<EdgeId>& settled,
                   Seeds& seeds);

/// Free faces by how many edges lie between them and the rim, farthest first: each hands its odd side on.
/// A mapped face between two free ones passes a side from one of its sides to the one opposite.
void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike, Seeds& seeds);

/// No quads fill a rim with an odd number of sides. Where all are given, the longest of the rim's that no
/// kept quads of the source stand on is divided, or with wedges one cell is a triangle, and that is said.
/// @throw NotSweepable  "surface.sides_asked", "surface.odd_loop"  where no edge takes a side more.
void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
