// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <functional>
#include <vector>

namespace lacuna::closure {

/// Remove the intermediate points of straight lines across a flat face, and triangulate the parts of the face
/// again, without interior points. Otherwise a line could have more points than its mesh has nodes, and
/// facets between the points would fold.
/// @param parts  the parts of the face.
/// @param plane  the plane of the face.
/// @param lines  lines between the parts. Each edge of a line is straight between the points that stay.
/// @param keeps  whether an intermediate point stays; empty: none does.
void straighten_lines(topology::Model& model, const std::vector<FaceId>& parts, const geometry::Plane& plane,
                      const std::vector<std::vector<topology::EdgeUse>>& lines, const RunContext& context,
                      const std::function<bool(const Vec3&)>& keeps = {});

} // namespace lacuna::closure
