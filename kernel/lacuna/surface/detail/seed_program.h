// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/alike_edges.h>
#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// One program of whole numbers for the faces that must agree. Internal to this folder.
namespace lacuna::surface {

/// Numbers of sides with which all mapped and submapped faces close, and the free faces beside them, solved
/// as one program; `seed_source()` says which.
/// @return  edges of free faces that have numbers of sides of a grid so.
std::set<EdgeId> solve_together(const SeedTask& task, const FaceGrids& grids, const AlikeEdges& alike,
                                Seeds& seeds);

} // namespace lacuna::surface
