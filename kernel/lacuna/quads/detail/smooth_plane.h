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
/// 1. Where a corner is folded, the quads around it are untangled by foldover-free maps (Garanzha et al.
///    2021) in two dimensions: ε decreases as the smallest determinant grows, and each step is a minimisation
///    by L-BFGS.
/// 2. Each point in turn takes Newton steps on the convex energy of its corners, (|a|² + |b|²) / (2 det) and,
///    with a size h, (det/h² + h²/det) / 2. No step may fold a quad.
/// 3. The points of the worst quads are moved, one after the other, to the position with the largest minimum
///    sine around them, as long as no side becomes much shorter than those around it.
/// @post  the least scaled Jacobian is not smaller than before.
/// @throw Cancelled
/// @note  Deterministic for any number of threads. If there are 20,000 points or more, all threads share the
///         sweeps. O(points) for each sweep.
void smooth_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed,
                  const SmoothPlaneOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::quads
