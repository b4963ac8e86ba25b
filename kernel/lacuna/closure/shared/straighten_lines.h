// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <functional>
#include <vector>

namespace lacuna::closure {

/// Remove the intermediate points of straight lines across a flat face, and triangulate the parts of the face
/// anew, without interior points. A line with more points than its mesh has nodes would fold facets.
/// @param parts  the parts of the face.
/// @param plane  the plane of the face.
/// @param lines  lines between the parts. Each of their edges is straight, or straight between the points
///         that it keeps.
/// @param keeps  whether an intermediate point stays; empty: none does.
void straighten_lines(topology::Model& model, const std::vector<FaceId>& parts, const geometry::Plane& plane,
                      const std::vector<std::vector<topology::EdgeUse>>& lines, const RunContext& context,
                      const std::function<bool(const Vec3&)>& keeps = {});

} // namespace lacuna::closure
