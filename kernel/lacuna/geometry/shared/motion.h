// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <functional>
#include <memory>
#include <vector>

namespace lacuna::geometry {

/// The motion that sweeps a source to its target: where each point of the source is at heights from 0 to 1.
///
/// A motion is affine (`at`), or each point moves straight by a vector of its own (`reach`).
struct Motion {
    /// The map from the source to a height; the identity at 0. Null with `reach`.
    std::function<Eigen::Affine3d(double height)> at;
    /// Null, or the vector from a point of the source to its place on the target.
    std::function<Vec3(const Vec3& point)> reach;
    std::vector<double> levels{0, 1}; ///< where the path has corners: increasing, from 0 to 1
    /// Where the walls get rows of facets: increasing, from 0 to 1, the levels included. Between two levels
    /// without a row of facets all points move straight.
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

/// The part of an affine motion between two heights, as a motion of the source moved to the first one. With
/// `from` above `to` it runs backwards. Null for a motion with `reach`, which places points of the source
/// alone.
MotionPointer part_of_motion(const MotionPointer& whole, double from, double to);

/// The motion along a vector.
Motion translation(const Vec3& vector);
/// The motion round an axis by an angle [radian], and along it by a pitch for each full turn.
/// @param direction  of length 1.
Motion screw(const Vec3& point, const Vec3& direction, double angle, double pitch);

/// Twist [radian] and scale of the section at each height.
struct Distortion {
    std::function<double(double height)> twist, scale; ///< null: none
    double most_twist = 0;                             ///< sum of the changes of the twist [radian]
    bool even = true;                                  ///< both change evenly with the height
};

/// A motion of the distorted section: it is twisted about a line and scaled from its point, and then moved.
/// @param direction  of the line, where the motion starts; of length 1.
Motion distorted(Motion motion, const Vec3& centre, const Vec3& direction, const Distortion& by);

/// Add rows of facets until a turn of the motion between two levels is divided into `kRowTurn` or less.
/// @param turn  between each two levels [radian].
void divide_turns(Motion& motion, const std::vector<double>& turn);

/// Rows of facets per full turn are those of finely faceted CAD: chords sag by 0.1 % of the radius.
inline constexpr double kRowsPerTurn = 72;

} // namespace lacuna::geometry
