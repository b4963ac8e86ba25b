// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <span>

/// Nodes twice in one place. Internal to this folder.
namespace lacuna::quality {

/// Bounds of the points; empty when one of them is not a finite number. Parallel.
Eigen::AlignedBox3d finite_bounds(std::span<const Vec3> points, const RunContext& context);

/// Points closer than this are in one place: 1e-9 of the diagonal.
inline double coincidence_tolerance(const Eigen::AlignedBox3d& bounds)
{
    return 1e-9 * bounds.diagonal().norm();
}

/// Two points within `tolerance` of each other, some of the points of `bounds`.
std::optional<std::array<Index, 2>> find_coincident(std::span<const Vec3> points, double tolerance,
                                                    const Eigen::AlignedBox3d& bounds,
                                                    const RunContext& context);

/// Two points within 1e-9 of the diagonal of `bounds`, the same pair for any thread count. O(points).
/// @pre  bounds holds every point.
std::optional<std::array<Index, 2>> find_coincident(std::span<const Vec3> points,
                                                    const Eigen::AlignedBox3d& bounds,
                                                    const RunContext& context);

} // namespace lacuna::quality
