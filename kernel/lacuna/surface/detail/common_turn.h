// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// Position of a linking surface without side lines if all loops rotate as one rigid body.
struct CommonTurn {
    double start = 0; ///< image of the source chain's start on the target chain [running length]
    /// s of the target end of the shortest path up the walls, whole turns included: see
    /// `LinkingSurface::branch`.
    double branch = 0;
};

/// Points around a ring: one every 3.75 degrees. A parabola interpolates the shift between them.
inline constexpr std::size_t kRingPoints = 96;

/// `kRingPoints` points at even steps of a closed chain.
std::vector<Vec3> round_points(const Chain& chain);

/// The shift of the target's points against the source's, in turns [0, 1), that minimizes the distance of the
/// rings after rotation about their centres.
/// @pre  `kRingPoints` points on both, at even steps.
double best_shift(std::vector<Vec3> source, std::vector<Vec3> target, const Eigen::Matrix3d& turn);

/// The rotation of each linking surface without side lines; none for a linking surface with side lines.
///
/// The rotation is that of the rigid motion that best fits the loops' centres and the points paired by side
/// lines. Whole turns are added so that it differs as little as possible from the rotation that the loop's
/// own walls give. The rotation is undetermined, and not returned, for a single loop, for concentric loops,
/// for a loop with corresponding vertices, or if all linking surfaces have side lines.
std::vector<std::optional<CommonTurn>> common_turns(std::span<const LinkingSurface> links);

} // namespace lacuna::surface
