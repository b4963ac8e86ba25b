// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Give walls that an end runs into smoothly the role of that end, up to the next rim with other walls.
///
/// A cell between an end and a wall that is tangent to it has an angle near 180° there. Ends and walls with
/// a given mesh keep their roles, and so does an end that reaches the opposite one or a missing wall, gains
/// or loses a loop, or becomes deeper than it is wide.
/// @param sealed  watertight and oriented; its roles change.
/// @return  the walls that joined an end.
/// @throw Cancelled
/// @note  O(facets).
std::vector<FaceId> extend_smooth_ends(topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
