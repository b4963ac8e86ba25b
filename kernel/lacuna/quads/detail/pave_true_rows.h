// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <functional>

namespace lacuna::quads::paving {

/// Move the nodes of the first row to where its quads stand upright on the boundary, as high as asked.
///
/// A node over a flat boundary node is moved where the worst quad around it stays good, or gets no worse.
/// Smoothing alone lets rows grow where sides bend away.
void true_rows(PlanarQuads& mesh, const PlanarRegion& region,
               const std::function<double(const Vec2&)>& height);

} // namespace lacuna::quads::paving
