// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/outline_symmetry.h>

#include <span>

namespace lacuna::quads::paving {

/// Improve row quads that are not good by the measure of `measure_plane()`, by moving their nodes and those
/// of the quads around them. Then, if fewer sides than promised have the size asked, improve the sides as
/// well. Smoothing spreads the distortion of an irregular node evenly over all quads, but a few degrees off a
/// right angle matter most along the boundary.
///
/// Algorithm: pattern search for each such node. It minimises how far corners and heights of row quads, and
/// lengths of sides, exceed their limits, plus a small multiple of the quads' own energy. No quad gets worse
/// than the worst of the mesh, unless it remains good.
/// @param symmetries  of the mesh, from `mesh_symmetries()`; they are preserved to rounding: the search moves
///                    one node of each set of images, and the others with it.
/// @post   The mesh stays as it is unless the mean scaled Jacobian plus half the shares of good rows and of
/// good sizes increases. The part of a share above 95 % counts only a quarter, and no share falls from above
/// 95 % to below.
/// @pre    `find_fault()` finds no fault, and the symmetries map nodes to the positions of their images.
/// @note   Deterministic. O(quads), plus about 10^4 evaluations of a quad for each row quad that is not good.
void square_rows(PlanarQuads& mesh, const PlanarRegion& region, std::span<const Symmetry> symmetries = {});

} // namespace lacuna::quads::paving
