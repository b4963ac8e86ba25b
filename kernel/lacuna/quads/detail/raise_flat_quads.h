// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// Move the points of folded and nearly flat quads, one at a time, so that the worst quad around the point
/// improves. This opens most folds that straight cuts cause, so that fewer quads must be untangled.
/// @param fixed  number of points that stay; they come first.
void raise_flat_quads(PlanarQuads& mesh, std::size_t fixed);

} // namespace lacuna::quads::paving
