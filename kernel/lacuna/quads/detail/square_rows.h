// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/outline_symmetry.h>

#include <span>

namespace lacuna::quads::paving {

/// Make row quads good that are not, by the measure of `measure_plane()`, moving nodes of theirs and of the
/// quads around them; then, where fewer sides than promised are of the size asked, those as well. Smoothing
/// spreads what an irregular node takes over all quads alike, and a few more degrees off a right angle matter
/// along the boundary most.
///
/// Algorithm: pattern search of each such node for the least sum of how far corners and heights of row quads
/// are beyond their limits, and lengths of sides beyond theirs, with a little of the quads' own energy. No
/// quad gets worse than the worst of the mesh, nor than is good.
/// @param symmetries  of the mesh, as `mesh_symmetries()` finds them, which it keeps to rounding: one node of
///                    those that are images of each other is searched for, and the others go with it.
/// @post   The mesh stays as it is unless the mean scaled Jacobian and half the shares of good rows and sizes
///         are more in sum; what a share has beyond 95 % counts for a quarter, and none falls below that.
/// @pre    `find_fault()` finds none, and the symmetries map nodes to where their images are.
/// @note   Deterministic. O(quads), and some 10^4 evaluations of a quad for each row quad that is not good.
void square_rows(PlanarQuads& mesh, const PlanarRegion& region, std::span<const Symmetry> symmetries = {});

} // namespace lacuna::quads::paving
