// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::quads {

/// Untangle folded quads by moving the points around them (foldover-free maps, Garanzha et al. 2021, in two
/// dimensions).
///
/// The folded quads and a few rings around them are minimised by L-BFGS, ε falling as the least determinant
/// rises.
/// @param fixed  the first points, which stay.
/// @return true when every corner is positive except those of three fixed points. Where it fails the points
///         are as they were.
bool untangle_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed);

} // namespace lacuna::quads
