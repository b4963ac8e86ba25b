// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/outline_symmetry.h>

#include <span>

namespace lacuna::quads::paving {

/// Improve the row quads that `measure_plane()` does not count as good: move their nodes, and the nodes of
/// the quads around them. If less than `kPromisedShare` of the sides have the requested size, improve the
/// lengths of sides as well. Smoothing spreads the distortion of an irregular node evenly over all quads, but
/// along the boundary even a few degrees off a right angle matter.
///
/// Algorithm: pattern search for the position of each of these nodes. The search minimises the amounts by
/// which corners and heights of row quads, and lengths of sides, exceed their limits, plus a small multiple
/// of the shape energy (`StarEnergy`). A quad may get worse than the worst quad of the mesh only if it
/// remains good.
/// @param symmetries  symmetries of the mesh, from `mesh_symmetries()`. They are preserved up to rounding:
///         the search moves one node, and moves all images of this node accordingly.
/// @post   The mesh changes only if its value increases. The value is the mean scaled Jacobian, plus half the
///         share of good row quads, plus half the share of sides of the requested size. The part of a share
///         above 95 % counts only a quarter. No share falls from above 95 % to below.
/// @pre    `find_fault()` finds no fault, and the symmetries map nodes to the positions of their images.
/// @note   Deterministic. O(quads), plus about 10^4 evaluations of a quad for each row quad that is not good.
void square_rows(PlanarQuads& mesh, const PlanarRegion& region, std::span<const Symmetry> symmetries = {});

} // namespace lacuna::quads::paving
