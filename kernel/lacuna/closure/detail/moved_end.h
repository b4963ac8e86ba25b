// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A sealed volume that had one end, and lacked the other end and some walls.
struct MovedEnd : Closed {
    FaceId from;          ///< the given end that was moved, in the input model
    double enclosed = 0;  ///< [model length³]
    bool through = false; ///< whether a rim without walls was extended, which is an assumption
    bool holes = false;   ///< whether such rims include holes
};

/// Seal faces that lack an end and adjacent walls, with the shape of the given end.
///
/// Where walls are given, their tops lie on the rim of the missing end. Maps from the given end's rim to
/// those tops are fitted in this order: a translation, a rigid motion, a rigid motion with a scale, and an
/// affine map if there are four corners or more. The first map that takes the foot of every wall to its top
/// is applied to the rest of the rim too, including round holes without walls. If no map does, missing
/// straight sides become straight lines between tops in one plane. The missing end then has the given end's
/// shape, and the missing walls are closed between the two ends. Scales, affine maps and straight sides are
/// tried only if walls cover a third of the outline, because the taper of a bore is not that of the outline.
/// The map must move every part of the rim.
/// @param known  tells whether some points all lie on existing faces. If this holds for the points on the rim
///         of a missing end and at mid-height of the missing walls, nothing is sealed.
/// @return  one result for each flat face that can be the given end: all other faces are walls connected to
///         it, and some walls beside it are missing. If there are many such faces, those with the most
///         adjacent faces are tried.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
std::vector<MovedEnd> move_ends(const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::function<bool(const std::vector<Vec3>&)>& known,
                                const RunContext& context);

/// Seal, in the same way, a volume whose source the user named, with the given walls. Empty if the walls do
/// not determine the missing end.
/// @pre  `open` has no target
std::optional<MovedEnd> move_source(const topology::OpenVolume& open, const RunContext& context);

} // namespace lacuna::closure
