// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Give walls that meet an end smoothly the role of that end, then also walls that meet these walls smoothly,
/// and so on.
///
/// A cell between an end and a wall tangent to it would have an angle near 180°. An end is not extended in
/// any of these cases:
/// - it has a void face or a face with a given mesh, or would get one;
/// - it would include or touch the opposite end;
/// - its number of loops would change;
/// - it would be deeper than wide.
/// @param sealed  watertight and oriented; its roles change.
/// @return  the walls that became part of an end.
/// @throw Cancelled
/// @note  O(facets).
std::vector<FaceId> extend_smooth_ends(topology::OpenVolume& sealed, const RunContext& context);

} // namespace lacuna::closure
