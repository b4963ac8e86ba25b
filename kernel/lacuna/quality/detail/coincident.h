// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <array>
#include <optional>
#include <span>

/// Search for coincident nodes. Internal to this folder.
namespace lacuna::quality {

/// Bounding box of the points; empty if a point is not finite. Parallel.
Eigen::AlignedBox3d finite_bounds(std::span<const Vec3> points, const RunContext& context);

/// Points closer than this coincide: `kSamePlace` × the diagonal.
inline double coincidence_tolerance(const Eigen::AlignedBox3d& bounds)
{
    return kSamePlace * bounds.diagonal().norm();
}

/// Find two points within `tolerance` of each other; the same pair for any number of threads. O(points).
/// @param level  number of points in each of consecutive levels; 0: no levels. Levels that can be separated
///               along a line are searched one by one, in less than half the time.
/// @pre  `bounds` contains every point.
std::optional<std::array<Index, 2>> find_coincident(std::span<const Vec3> points, std::size_t level,
                                                    double tolerance, const Eigen::AlignedBox3d& bounds,
                                                    const RunContext& context);

} // namespace lacuna::quality
