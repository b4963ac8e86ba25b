// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/model.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The edge in which a plane meets the circular cylinder along some consecutive sides of a missing face, from
/// the end of the last side to the start of the first one. The face does not run round the axis.
/// @param sides  the places of each side, both ends included. Sides that are arcs about the axis or straight
///               determine the axis.
/// @return  empty if the sides are not on one cylinder, if the plane is parallel to its axis, or if the edge
///          would be straight.
std::vector<Vec3> edge_in_plane(const std::vector<std::vector<Vec3>>& sides, const geometry::Plane& plane);

/// Whether the sides of a rim that given faces share determine a circular cylinder or cone on which the whole
/// rim lies, and the rim does not run round its axis.
bool given_sides_show_round_wall(const topology::Model& model, const topology::Loop& loop);

/// Fill a rim with a face on the circular cylinder or cone through the rim, unless the rim runs round the
/// axis of that surface. The surface is found from an edge of the rim that is an arc about its axis, or from
/// a straight edge along the axis of a cylinder. The facets are made on the unrolled surface.
/// @return  empty if the rim lies on no such surface.
std::optional<VoidFilling> fill_round_patch(const topology::Model& model, const topology::Loop& loop,
                                            const RunContext& context);

} // namespace lacuna::closure
