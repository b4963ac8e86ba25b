// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// Fill anew, with quads that are convex for certain, what lies around the folded ones.
///
/// The quads flatter than `flat` and those around them are taken out, more rings of them until the holes have simple
/// outlines that cross nowhere; at worst that is the whole region. Each hole is filled with triangles, paired
/// where that gives convex quads, and split (`split_cells()`).
/// @param size  edge length to aim for [length].
/// @return how many holes were filled; 0 where nothing is flat.
/// @post  all quads are convex, if `region`'s loops are simple and the quads' sides match.
/// @note  Deterministic. O(quads) and what is filled.
int refill_folds(PlanarQuads& mesh, const PlanarRegion& region, double flat,
                 const std::function<double(const Vec2&)>& size);

} // namespace lacuna::quads::paving
