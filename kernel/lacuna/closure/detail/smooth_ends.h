// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Give walls that meet an end smoothly the role of that end, up to the next rim with other walls.
///
/// A cell between an end and a wall tangent to it would have an angle near 180°. Ends and walls with a given
/// mesh keep their roles. An end is not extended if it would then reach the opposite end or a missing wall,
/// gain or lose a loop, or be deeper than wide.
/// @param sealed  watertight and oriented; its roles change.
/// @return  the walls that became part of an end.
/// @throw Cancelled
/// @note  O(facets).
std::vector<FaceId> extend_smooth_ends(topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
