// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/face_grids.h>

/// An even number of sides round every free face. Internal to this folder.
namespace lacuna::surface {

/// Free faces by how many edges lie between them and the rim, farthest first: each hands its odd side on.
/// A mapped face between two free ones passes a side from one of its sides to the one opposite.
void make_even(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike, Seeds& seeds);

/// No quads fill a rim with an odd number of sides. Where all are given, the longest of the rim's that no
/// kept quads of the source stand on is divided, or with wedges one cell is a triangle, and that is said.
/// @throw NotSweepable  "surface.sides_asked", "surface.odd_loop"  where no edge takes a side more.
void finish_even(const SeedTask& task, const FaceGrids& grids, Seeds& seeds);

} // namespace lacuna::surface
