// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Add a four-sided wall, given its sides.
void add_wall(FlatFilling& filling, const std::vector<std::vector<topology::EdgeUse>>& sides,
              const RunContext& context);

/// Add missing round walls between free loops, such as the wall of a bore or of a shaft. Each wall joins two
/// rims on one axis with equal radii.
///
/// A rim needs a wall in two cases:
/// - a flat face in the rim would lie in the plane of the given faces round it;
/// - the rim is not planar, and no given face at the rim is a part of the round wall.
///
/// Rims that need a wall are paired along their common axis. If their number is odd, one rim that a flat face
/// could close as well is added, so that the walls are shortest. If no rim needs a wall, the two rims of two
/// unconnected parts are paired. Loops on the wall between two rims, such as those of branches, are holes
/// of that wall.
///
/// Of the rims that are left, circles are joined by conical walls to other rims on their axis, if one of both
/// needs a wall or no other loop is left. A straight wall up to the plane of the next flat rim is likelier,
/// unless the cone is one of 45°, such as a chamfer.
/// @return  the free loops that are left.
std::vector<topology::Rim> add_tubes(FlatFilling& filling, std::vector<topology::Rim> loops,
                                     const RunContext& context);

/// Whether a flat face in a rim would lie in the plane of all given faces round the rim. If so, a wall is
/// missing there.
bool continues_given_planes(const topology::Model& model, const topology::Rim& rim);

/// Whether a curved void face joins two rims of different lengths, and a flat face would continue the given
/// planes at exactly one of them. Then a straight wall from that rim, with a flat face at its end, is as
/// likely as the curved face, if the given faces at the other rim run along that wall. A cone of 45°, such as
/// a chamfer, is likelier.
bool is_ring_at_step(const topology::Model& model, FaceId face);

/// Whether a void face joins two rims and is neither curved like a sphere, cylinder or cone, nor straight
/// from rim to rim.
bool is_bent_ring(const topology::Model& model, FaceId face);

/// Close rims in whose plane the given faces continue (see `continues_given_planes()`) by straight walls.
///
/// The wall of such a rim is perpendicular to the rim's plane and ends in the plane of another flat rim. This
/// is the nearest one with these properties:
/// - the planes of both rims are parallel;
/// - the given walls at the other rim are perpendicular to the planes;
/// - the image of the rim in the plane of the other rim lies inside the other rim or encloses it.
///
/// In that plane, the image and the other rim bound a missing flat face. Example: a bore that is missing
/// together with the face around its mouth.
/// @param loops  flat loops of missing faces; they may contain void edges.
/// @return  the loops of the faces that are left; the image of a rim takes the place of the rim.
std::vector<topology::Loop> add_straight_walls(FlatFilling& filling, std::vector<topology::Loop> loops,
                                               const RunContext& context);

} // namespace lacuna::closure
