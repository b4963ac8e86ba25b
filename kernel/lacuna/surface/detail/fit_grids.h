// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// Numbers of sides for which a grid fills a free face. Internal to this folder.
namespace lacuna::surface {

/// Give free faces numbers of sides for which a grid fills them. Faces are treated one after the other. A
/// face whose loops constrain each other, such as a ring, comes before a face that shares its edges, such as
/// the disc inside the ring. Edges of mapped faces are not changed.
/// @param settled  further edges that are not changed.
/// @return  `settled` and the edges whose numbers of sides are now those of a grid.
/// @throw Cancelled
std::set<EdgeId> fit_grids(const SeedTask& task, const FaceGrids& grids, std::set<EdgeId> settled,
                           Seeds& seeds, const RunContext& context);

} // namespace lacuna::surface
