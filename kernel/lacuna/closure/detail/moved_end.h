// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A volume with one end given, the other missing and walls missing too, sealed.
struct MovedEnd {
    topology::OpenVolume volume; ///< the given faces in their order, then those made; with roles
    Closure closure;
    FaceId from;          ///< the end that was moved, of the faces asked for
    double enclosed = 0;  ///< [model length³]
    bool through = false; ///< whether a rim without walls was taken to go through, which nothing tells
    bool holes = false;   ///< whether that holds for holes
};

/// Seal some faces that lack an end and walls beside it as the given end tells.
///
/// Where walls stand, their tops say where the rim of the missing end is. A rotation, a scale and a shift are
/// fitted from the given end's rim to those tops, or an affine map that four corners or more tell; where one
/// moves every wall's foot onto its top, it moves the rest of the rim as well, round holes without walls too.
/// Failing that, missing sides that are straight run straight between tops that lie in one plane. What is
/// missing then has the given end's shape, and walls are closed between the two ends. A scale is taken only
/// from walls along a third of the outline: the taper of a bore says nothing of it. No part of the rim may
/// stay where it is.
/// @param known  whether places on the missing end's rim and half way up the missing walls lie on what was
///               made already; where one end's do, nothing is sealed
/// @return  one for each flat face that can be such an end: all other faces are walls that hang together with
///          it, and walls beside it are missing. Of many such faces those with most faces beside them are
///          tried.
/// @throw InvalidInput  faces that cannot be oriented. Cancelled.
std::vector<MovedEnd> move_ends(const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::function<bool(const std::vector<Vec3>&)>& known,
                                const RunContext& context);

/// Likewise where a person named the given end as the source and what stands as its walls; none where these
/// do not tell the missing end.
/// @pre  `open` has no target
std::optional<MovedEnd> move_source(const topology::OpenVolume& open, const RunContext& context);

} // namespace lacuna::closure
