// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// Make row quads good that are not, by the measure of `measure_plane()`, moving nodes of theirs and of the
/// quads around them. Smoothing spreads what an irregular node takes over all quads alike, and a few more
/// degrees off a right angle matter along the boundary most.
///
/// Algorithm: pattern search of each such node for the least sum of how far corners and heights of row quads
/// are beyond their limits, with a little of the quads' own energy. No quad gets worse than the worst of the
/// mesh, nor than is good.
/// @return how many more row quads are good; 0 where the mesh stays as it is, also where the mean scaled
///         Jacobian or the share of edges of the size asked would become noticeably less.
/// @pre    `find_fault()` finds none.
/// @note   Deterministic. O(quads), and some 10^4 evaluations of a quad for each row quad that is not good.
std::size_t square_rows(PlanarQuads& mesh, const PlanarRegion& region);

} // namespace lacuna::quads::paving
