// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <vector>

namespace lacuna::geometry {

/// The motion that sweeps a source to its target. It defines the position of each source point at every
/// height; the height is a parameter from 0 (source) to 1 (target). The motion is either affine (`at` is
/// set), or each point moves along a straight line by a vector of its own (`reach` is set).
struct Motion {
    /// The map from the source to a height; the identity at 0. Null with `reach`.
    std::function<Eigen::Affine3d(double height)> at;
    /// Null, or the vector from a point of the source to its place on the target.
    std::function<Vec3(const Vec3& point)> reach;
    /// Heights of the start, the corners and the end of the path: increasing, from 0 to 1.
    std::vector<double> levels{0, 1};
    /// Heights at which walls get rows of facet corners: increasing, from 0 to 1. All `levels` are included.
    /// If there is no row between two levels, all points move straight from one level to the other.
    std::vector<double> rows{0, 1};

    /// The place of a point of the source at a height.
    [[nodiscard]] Vec3 place(const Vec3& point, double height) const
    {
        return reach ? Vec3(point + height * reach(point)) : Vec3(at(height) * point);
    }
    /// The affine map to a height; the identity with `reach`.
    [[nodiscard]] Eigen::Affine3d map(double height) const
    {
        return reach ? Eigen::Affine3d::Identity() : at(height);
    }
};

using MotionPointer = std::shared_ptr<const Motion>;

/// The part of an affine motion between two heights, as a motion of the source moved to height `from`. If
/// `from` is above `to`, it runs backwards. Null if the motion has a `reach`, which is defined at source
/// points only.
MotionPointer part_of_motion(const MotionPointer& whole, double from, double to);

/// The motion along a vector.
Motion translation(const Vec3& vector);
/// The motion that turns round an axis by an angle [radian] and moves along it by `pitch` for each full turn.
/// @param direction  of length 1.
Motion screw(const Vec3& point, const Vec3& direction, double angle, double pitch);

/// Twist [radian] and scale of the section at each height.
struct Distortion {
    std::function<double(double height)> twist, scale; ///< null: none
    double most_twist = 0; ///< sum of the absolute changes of the twist over the height [radian]
    bool even = true;      ///< whether twist and scale are linear functions of the height
};

/// A motion of a distorted section: the section is twisted about a line, scaled from a point of the line, and
/// then moved.
/// @param centre     the point of the line.
/// @param direction  direction of the line at the start; of length 1.
Motion distorted(Motion motion, const Vec3& centre, const Vec3& direction, const Distortion& by);

/// Add rows to `Motion::rows` until the motion turns by at most a full turn / `kFineChords` between two
/// neighbouring rows.
/// @param turn  turn between each level and the next [radian].
void divide_turns(Motion& motion, const std::vector<double>& turn);

} // namespace lacuna::geometry
