// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Give walls that meet an end smoothly, directly or through each other, the role of that end.
///
/// A cell between an end and a wall tangent to it would have an angle near 180°. An end stays as it is in any
/// of these cases: it has a void face or a given mesh, or would include one; it would include or touch the
/// opposite end; it would gain or lose a loop; it would be deeper than wide.
/// @param sealed  watertight and oriented; its roles change.
/// @return  the walls that became part of an end.
/// @throw Cancelled
/// @note  O(facets).
std::vector<FaceId> extend_smooth_ends(topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
