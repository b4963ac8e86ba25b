// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// How a linking surface without side lines lies when all loops turn as one body.
struct CommonTurn {
    double start = 0; ///< where on its target chain its source chain's start belongs [running length]
    /// S of the target end of its shortest way up, with whole turns counted: see `LinkingSurface::branch`.
    double branch = 0;
};

/// Points round a ring: one every 4 degrees, and a parabola finds the shift between them.
inline constexpr std::size_t kRingPoints = 96;

/// `kRingPoints` points at even lengths of a closed chain.
std::vector<Vec3> round_points(const Chain& chain);

/// The shift of the target's points against the source's, in turns [0, 1), that leaves the turned rings
/// closest about their centres.
/// @pre  `kRingPoints` points on both, at even lengths round.
double best_shift(std::vector<Vec3> source, std::vector<Vec3> target, const Eigen::Matrix3d& turn);

/// The turns of linking surfaces without side lines; none for a linking surface that has them.
///
/// The turn is the rigid motion that fits the loops' centres, and the points that side lines pair, best. It
/// is followed from row to row of the walls, so that half a turn and more to one side is not taken for less
/// to the other. None is given when nothing tells it: one loop, loops about one centre, or no linking surface
/// without side lines.
std::vector<std::optional<CommonTurn>> common_turns(const topology::OpenVolume& volume,
                                                    std::span<const LinkingSurface> links);

} // namespace lacuna::surface
