// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// Numbers of sides for which a grid fills a free face. Internal to this folder.
namespace lacuna::surface {

/// Give free faces numbers of sides for which a grid fills them. Faces are treated one after the other, those
/// with the most loops first: a ring, whose two loops constrain each other, comes before the disc inside it.
/// Edges of mapped and submapped faces are not changed.
/// @param settled  further edges that are not changed.
/// @return  `settled` and the edges whose numbers of sides are now those of a grid.
/// @throw Cancelled
std::set<EdgeId> fit_grids(const SeedTask& task, const FaceGrids& grids, std::set<EdgeId> settled,
                           Seeds& seeds, const RunContext& context);

} // namespace lacuna::surface
