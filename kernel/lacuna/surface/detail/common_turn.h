// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace lacuna::surface {

/// The rotation of a linking surface without side lines between source and target, if all loops rotate as one
/// rigid body.
struct CommonTurn {
    double start = 0; ///< image of the source chain's start on the target chain [running length]
    /// As `LinkingSurface::branch` [turns].
    double branch = 0;
};

/// `kFineChords` points at even steps of a closed chain.
std::vector<Vec3> round_points(const Chain& chain);

/// The shift of the target's points relative to the source's, in turns [0, 1). It minimizes the distance
/// between the two rings after both are moved to a common centre and the source's ring is rotated by `turn`.
/// Between the points, a parabola interpolates the best shift.
/// @pre  both have equally many points at even steps.
double best_shift(std::vector<Vec3> source, std::vector<Vec3> target, const Eigen::Matrix3d& turn);

/// For each linking surface without side lines, its rotation. The rotation is that of the rigid motion that
/// best fits the loops' centres and the points paired by side lines. Whole turns are added for each loop, so
/// that its rotation differs as little as possible from the rotation of its own walls.
/// @return  empty for a linking surface with side lines or with given pairs of corresponding vertices. Empty
///         for all if the motion is undetermined: for a single loop, for concentric loops, or if all linking
///         surfaces have side lines.
std::vector<std::optional<CommonTurn>> common_turns(std::span<const LinkingSurface> links);

} // namespace lacuna::surface
