// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A sealed volume whose missing end was made by moving the given end.
struct MovedEnd : Closed {
    FaceId from;          ///< the given end that was moved, in the input model
    double enclosed = 0;  ///< [model length³]
    bool through = false; ///< whether a rim without any wall was extended, which is an assumption
    bool holes = false;   ///< whether the given end has holes without walls
};

/// Seal faces that lack one end and some walls beside it. The missing end gets the shape of the given end.
///
/// The foot of a wall is its edge on the given end's rim; its top is its edge on the missing end's rim. A map
/// from the feet to the tops of the given walls is fitted. The first of these maps is taken that moves each
/// foot to its top and moves every part of the rim without a wall:
/// 1. a translation;
/// 2. a rigid motion;
/// 3. a rigid motion with a scale factor;
/// 4. an affine map, if there are at least four corners.
///
/// Maps 3 and 4 are tried only if walls cover a third of the outline: the taper of bores does not determine
/// that of the outline. The map is applied to the rest of the rim too, including holes without walls. If none
/// of the maps fits, but the missing sides are straight and all tops lie in one plane, straight lines between
/// the tops complete the rim. The missing walls are then closed between the two ends.
/// @param known  tells whether all given points lie on faces that are known already. It is called with points
///         on the rim of the missing end and at mid-height of the missing walls. If it returns true, the
///         result is empty.
/// @return  one result for each flat face that can be the given end; all other faces are then walls. Some
///         walls beside this face must be given and others missing. Of more than 16 such faces, those with
///         the most adjacent faces are tried. Empty if the faces are not connected.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
std::vector<MovedEnd> move_ends(const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::function<bool(const std::vector<Vec3>&)>& known,
                                const RunContext& context);

/// Seal a volume whose source is named, in the same way. Empty if the given walls do not determine the
/// missing end.
/// @pre  `open` has no target
std::optional<MovedEnd> move_source(const topology::OpenVolume& open, const RunContext& context);

} // namespace lacuna::closure
