// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::closure {

/// Faces that may be rounds: walls only, or also faces of the ends, such as domes.
enum class RoundsOf { walls, ends_and_walls };

/// Divide rounds between an end and walls that lead away from the opposite end. A round is a curved face such
/// as the fillet round the top of a product in a box. It is divided where it is inclined by 45 degrees, and
/// its flatter part becomes part of the end. Layers then meet the remaining walls at 45 degrees or more; they
/// would be tangent to an undivided round.
///
/// The dividing plane is parallel to the end: facets on one side of it are flatter, on the other side
/// steeper. A round that the plane does not cut along closed lines stays whole. If there are rounds, the skin
/// is oriented away from the void.
///
/// Walls with the same names whose smooth common edges leave one vertex of an end's rim together, such as the
/// rounds and the corners at the bottom of a rounded box, are joined into one wall of facets.
/// @note  O(facets) for each part of the ends; without rounds, only the walls at the ends are visited.
void split_round_rims(topology::OpenVolume& volume, RoundsOf of, const RunContext& context);

} // namespace lacuna::closure
