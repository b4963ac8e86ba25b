// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace lacuna::quads {

struct SmoothPlaneOptions {
    /// Requested edge length [model length]; null: only the shape matters.
    std::function<double(const Vec2&)> size;
    int sweeps = 12;          ///< number of sweeps over all points, >= 0
    double size_weight = 0.1; ///< weight of size against shape, >= 0 [-]
    double good_enough = 0.7; ///< quads with a smaller scaled Jacobian are improved one by one [-]
    int repairs = 20;         ///< number of rounds over these quads, >= 0
    bool untangle = true;     ///< untangle folded quads first
};

/// Smooth quads of the plane by moving all points except the first `fixed` ones.
///
/// In the following, a and b are the two sides at a corner of a quad, and det = a × b is twice the area of
/// the triangle between them.
///
/// 1. Where a corner is folded (det <= 0), the quads around it are untangled by `untangle_plane()`.
/// 2. Each point in turn takes Newton steps that reduce an energy of the corners around it. This energy is
///    the sum of ((|a|² + |b|²) / (2 det))² and, with a requested size h, of (det/h² + h²/det) / 2 times
///    `size_weight`. No step may fold a quad.
/// 3. The points of the worst quads are moved, one after the other, to the position with the largest minimum
///    sine of the corners around them. Each point's shortest side keeps at least `kShortestKept` of its
///    length.
/// @post  the least scaled Jacobian is not smaller than before.
/// @throw Cancelled
/// @note  Deterministic for any number of threads. If there are 20,000 points or more, all threads share the
///         sweeps. O(points) for each sweep.
void smooth_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed,
                  const SmoothPlaneOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::quads
