// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// Move the points of folded and nearly flat quads, one at a time, to where the worst quad around is better.
/// Most folds that straight cuts make open by that, and less is left to untangle.
/// @param fixed  the first points, which stay.
void raise_flat_quads(PlanarQuads& mesh, std::size_t fixed);

} // namespace lacuna::quads::paving
