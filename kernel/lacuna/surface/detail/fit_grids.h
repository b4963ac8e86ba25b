// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// Numbers of sides for which a grid fills a free face. Internal to this folder.
namespace lacuna::surface {

/// Give free faces counts for which a grid closes. Faces whose loops constrain each other come before those
/// that depend on settled edges: a ring around a disc before the disc. Edges of mapped faces are not changed.
/// @param settled  edges that are not changed either.
/// @return  those, and the edges that now have counts of a grid.
/// @throw Cancelled
std::set<EdgeId> fit_grids(const SeedTask& task, const FaceGrids& grids, std::set<EdgeId> settled,
                           Seeds& seeds, const RunContext& context);

} // namespace lacuna::surface
