// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/face_grids.h>

#include <set>

/// Numbers of sides with which one grid fills a free face. Internal to this folder.
namespace lacuna::surface {

/// Give free faces numbers of sides that one grid can have, those first whose loops have to agree with each
/// other, before those that take what is settled: a ring about a disc before the disc. Edges of mapped faces
/// keep theirs.
/// @param settled  edges that keep theirs as well.
/// @return  those, and the edges that have numbers of a grid now.
/// @throw Cancelled
std::set<EdgeId> fit_grids(const SeedTask& task, const FaceGrids& grids, std::set<EdgeId> settled,
                           Seeds& seeds, const RunContext& context);

} // namespace lacuna::surface
