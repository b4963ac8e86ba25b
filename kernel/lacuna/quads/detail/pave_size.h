// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <functional>

namespace lacuna::quads::paving {

/// The edge length to aim for: what the region asks for, limited near the boundary by the lengths of its
/// given sides.
///
/// At distance d from a boundary node with sides of length l it lies between l − g d and l + g d, with g the
/// grading. Where the sides have about the length asked, that changes nothing and the region's own size is
/// handed back. A region without a size has its mean boundary side.
/// @param grading  change of size over distance; the default keeps neighbouring edges within 1.3 of each
///                 other [-].
/// @param alike    a side has about the length asked where the two differ by less than this factor [-].
std::function<double(const Vec2&)> size_with_boundary(const PlanarRegion& region, double grading = 0.3,
                                                      double alike = 1.6);

/// Sides of a ring may be 1 / 0.6 times as long as asked, or as short, and rows still of the size asked: what
/// rings are laid out with and all meshes judged by.
inline constexpr double kRingGrading = 0.3, kRingAlike = 1.75;

/// About how many quads a region gets: its area over that of a square on a mean boundary side.
double quads_within(const PlanarRegion& region);

/// Whether a mesh has as many quads as asked for, a quarter more or less: what is promised.
bool has_quads_asked(const PlanarQuads& mesh, const std::function<double(const Vec2&)>& size);

} // namespace lacuna::quads::paving
