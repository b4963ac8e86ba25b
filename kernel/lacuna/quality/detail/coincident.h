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

/// Two points within `tolerance` of each other, the same pair for any thread count. O(points).
/// @param level  points lie in levels of so many, one after the other; 0: in none. Levels between which there
///               is room along a line are looked at one by one, in less than half the time.
/// @pre  bounds holds every point.
std::optional<std::array<Index, 2>> find_coincident(std::span<const Vec3> points, std::size_t level,
                                                    double tolerance, const Eigen::AlignedBox3d& bounds,
                                                    const RunContext& context);

} // namespace lacuna::quality
