// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// Numbers of sides for which a grid fills a free face. Internal to this folder.
namespace lacuna::surface {

/// Give free faces counts for which a grid fills them. Faces whose loops constrain each other come before
/// faces that depend on settled edges: a ring around a disc before the disc. Edges of mapped faces are not
/// changed.
/// @param settled  edges that are not changed either.
/// @return  `settled`, and the edges that now have the counts of a grid.
/// @throw Cancelled
std::set<EdgeId> fit_grids(const SeedTask& task, const FaceGrids& grids, std::set<EdgeId> settled,
                           Seeds& seeds, const RunContext& context);

} // namespace lacuna::surface
