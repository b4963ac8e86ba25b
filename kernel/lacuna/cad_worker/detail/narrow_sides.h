// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/detail/cad_curves.h>

#include <vector>

namespace lacuna::cad_worker {

/// Factors by which to increase the number of points on each edge, from 1 to 8. The factors make the sag of
/// each segment at most a hundredth of its distance from any other edge of the same planar face, unless a
/// factor of more than 8 would be needed. Without them, the width of a thin ring would vary visibly, because
/// its circles become polygons.
///
/// Edges that share a vertex are not compared. Curved faces need no refinement: narrow ones, such as fillets,
/// are seldom next to the void.
/// @param wire  `divide()` has divided its edges.
/// @note  O(n log n) in the segments of a face, if few of them are close to each other.
std::vector<double> narrow_refinement(const CadWire& wire);

} // namespace lacuna::cad_worker
