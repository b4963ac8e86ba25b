// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <functional>

namespace lacuna::quads::paving {

/// The edge length to aim for: what the region asks, but near the boundary what its given sides allow.
///
/// Within a distance d of a boundary node with sides of length l it lies between l − g d and l + g d, with
/// g the grading. Where the sides have about the length asked, that changes nothing and the region's own
/// size is handed back; without one it is the mean boundary side.
std::function<double(const Vec2&)> size_with_boundary(const PlanarRegion& region, double grading = 0.3);

} // namespace lacuna::quads::paving
