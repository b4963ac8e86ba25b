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
    std::function<double(const Vec2&)>
        size;                 ///< edge length asked for [model length]; none: shape alone counts
    int sweeps = 12;          ///< over all points, >= 0
    double size_weight = 0.1; ///< of size against shape, >= 0 [-]
    double good_enough = 0.7; ///< quads with a smaller scaled Jacobian are worked on one by one [-]
    int repairs = 20;         ///< rounds over them, >= 0
    bool untangle = true;     ///< open what is folded first
    std::size_t still = 0;    ///< points before this one move only when one next to them has
};

struct SmoothedPlane {
    double min_before = 1, min_after = 1; ///< scaled Jacobian
    bool was_folded = false;              ///< some corner was not positive
    bool folded = false;                  ///< some still is not
};

/// Move points of the plane so that the quads on them become good; the first `fixed` stay where they are.
///
/// Where a corner is folded, the quads around are opened first (foldover-free maps, Garanzha et al. 2021, in two dimensions: ε
/// falls as the least determinant rises, L-BFGS inside). Then every point in turn takes Newton steps on the convex energy
/// of its corners, (|a|² + |b|²) / 2 det and, with a size, (det/h² + h²/det) / 2, which no step may fold; last the
/// worst quads are raised, one point after the other, to where the least sine around is largest.
/// @post  the least scaled Jacobian is not smaller than before.
/// @throw Cancelled
/// @note  Deterministic. O(points) a sweep.
SmoothedPlane smooth_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed,
                           const SmoothPlaneOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::quads
