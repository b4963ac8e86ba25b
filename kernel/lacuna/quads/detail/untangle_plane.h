// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::quads {

/// Untangle folded quads by moving the points around them (foldover-free maps, Garanzha et al. 2021, in two
/// dimensions).
///
/// L-BFGS minimises the foldover energy of the folded quads and of a few rings of quads around them. The
/// energy contains the determinant det of each corner, the cross product of its two sides. A regularisation ε
/// keeps the energy finite where det <= 0. Each minimisation uses a smaller ε as the smallest determinant
/// grows.
/// @param fixed  number of points that do not move; they come first.
/// @return true if every corner is positive, except corners whose three points are fixed. On failure no point
///         is moved.
bool untangle_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed);

} // namespace lacuna::quads
