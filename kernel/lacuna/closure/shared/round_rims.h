// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::closure {

/// Faces that may be rounds: walls only, or also faces of the ends, such as domes.
enum class RoundsOf { walls, ends_and_walls };

/// Whether one smooth face is an end and its walls at once: the undivided skin of a whole product. Such a
/// face has one rim and no given quads; in places it is perpendicular to the axis, in others as steep as a
/// wall.
/// @param axis  unit vector
bool is_end_with_walls(const topology::Model& model, FaceId face, const Vec3& axis);

/// Divide the rounds at the rims of the ends. Round: a curved face that meets an end smoothly and is inclined
/// to the end by less than 45° in places and by more in others, such as the fillet around the top of a
/// product in a box. A round is divided where its inclination is 45°. The flatter part becomes part of the
/// end, the other part is a wall. Layers of cells then meet the walls at 45° or more; they would be tangent
/// to an undivided round.
///
/// Adjacent rounds are divided together by a plane that is parallel to the end. They stay whole if the plane
/// does not cut them along closed lines. If there are rounds, the skin is oriented away from the void.
///
/// If several smooth edges between walls start at the same vertex of an end's rim, the walls on both sides of
/// these edges are joined into one faceted wall, provided that they have the same name and sets. Example: the
/// rounds and the corners at the bottom of a rounded box.
/// @note  O(facets) for each part of the ends; if there are no rounds, only the walls at the ends are
///         visited.
void split_round_rims(topology::OpenVolume& volume, RoundsOf of, const RunContext& context);

} // namespace lacuna::closure
