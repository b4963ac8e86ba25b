// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::closure {

/// Make lines across a flat face straight: drop the points inside their edges, and triangulate the parts of
/// the face anew, without points inside. A mesh with fewer nodes than these points would fold facets.
/// @param parts  of the face. @param plane  the face's. @param lines  between the parts; their edges are
///               straight.
void straighten_lines(topology::Model& model, const std::vector<FaceId>& parts, const geometry::Plane& plane,
                      const std::vector<std::vector<topology::EdgeUse>>& lines, const RunContext& context);

} // namespace lacuna::closure
