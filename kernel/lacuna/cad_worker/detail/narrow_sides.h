// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/detail/cad_curves.h>

#include <vector>

namespace lacuna::cad_worker {

/// How many times as many points each edge is to have, 1 or more, so that no side sags by more than a
/// hundredth of its distance from another edge of the same flat face: a ring of facets is else thicker and
/// thinner by as much as the polygons of its circles are off.
///
/// Edges that share a vertex do not count against each other. Curved faces ask for nothing: a fillet is
/// narrow beside its length, and what is beside it is seldom the void.
/// @param wire  its edges divided (`divide()`).
/// @cost  O(n log n) in the sides of a face where few of them are near each other.
std::vector<double> narrow_refinement(const CadWire& wire);

} // namespace lacuna::cad_worker
