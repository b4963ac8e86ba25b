// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Add missing round walls between free loops: the wall of a bore, of a shaft or of a cone between two rims
/// on one axis.
///
/// A rim needs such a wall in two cases: a flat face in the rim would lie in the plane of the given faces
/// round it; or the rim is not planar and the given faces round it do not continue the wall. Rims on one axis
/// with equal radii are paired along the axis. A rim left over is paired with a rim that a flat face could
/// also close. Rims of two unconnected parts are paired too. Loops on the wall between two rims, such as those
/// of branches, are holes of that wall.
/// @return  the free loops that are left.
std::vector<topology::Rim> add_tubes(FlatFilling& filling, std::vector<topology::Rim> loops,
                                     const RunContext& context);

/// Radius of a flat face whose only loop is a circle; empty for any other face.
std::optional<double> radius_of_disc(const topology::Model& model, FaceId face);

/// Whether a flat face in a rim would lie in the plane of all given faces round it. If so, a wall is missing
/// there.
bool continues_given_planes(const topology::Model& model, const topology::Rim& rim);

/// Whether a void face joins two rims of different lengths, of which one needs a wall. A straight wall that
/// ends in a flat face is then as likely.
bool is_ring_at_step(const topology::Model& model, FaceId face);

/// Whether a void face joins two rims and is neither round nor straight from rim to rim.
bool is_bent_ring(const topology::Model& model, FaceId face);

/// Add a straight wall from each flat rim that needs one to the nearest plane of another flat rim whose given
/// faces run along that wall. The image of the rim in this plane then bounds the face that is missing there.
/// This closes a bore that is missing together with the face at its mouth, or a shaft with the face at its
/// shoulder.
/// @return  the free loops that are left, the images among them.
std::vector<topology::Rim> add_straight_walls(FlatFilling& filling, std::vector<topology::Rim> loops,
                                              const RunContext& context);

/// Fill a rim with a face on the circular cylinder or cone through it, unless the rim runs round the axis of
/// that surface. An arc of the rim determines the surface; the facets are made on the unrolled surface.
/// @return  empty if the rim lies on no such surface.
std::optional<VoidFilling> fill_round_patch(const topology::Model& model, const topology::Loop& loop,
                                            const RunContext& context);

} // namespace lacuna::closure
