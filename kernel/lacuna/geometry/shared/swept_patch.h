// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Transfinite interpolation of four sides with a frame that rotates along them: for walls along a bend.
///
/// A Coons patch adds displacements in fixed axes. It squeezes half a tube along a bent path where the path
/// has turned away from both ends. Here the deviations of bottom and top from their chords are expressed in a
/// frame that follows the sides left and right: their direction, and the chord between them. x(s, t) = (1−s)
/// left(t) + s right(t) + size(t) F(t) [(1−t) b(s) + t e(s)], where b and e are the deviations of bottom and
/// top in the frames F(0) and F(1), divided by the lengths of the chords. All four sides are interpolated. If
/// the frame does not rotate and the lengths agree, the result is the Coons patch.
///
/// Around a bent seam (left and right coincide, bottom and top are closed) there is no chord. The frame then
/// moves along the seam with minimal rotation, plus a uniform twist for which the deviations of top and
/// bottom agree best. A circle swept along an arc gives the torus.
class SweptPatch {
public:
    /// Sides as polylines: bottom and top from left to right, left and right from
    /// bottom to top, with common corners.
    SweptPatch(std::span<const Vec3> bottom, std::span<const Vec3> right, std::span<const Vec3> top,
               std::span<const Vec3> left);

    /// The point at relative arc lengths of the sides, both in [0, 1].
    [[nodiscard]] Vec3 operator()(double s, double t) const;

    /// False if left and right are too close for a chord to define a frame and are not a bent seam: the patch
    /// is then a Coons patch.
    [[nodiscard]] bool turns() const { return turns_; }

    /// Difference between the deviations of bottom and top from their chords, each in its own frame and
    /// relative to its length. It is 0 if the top is the bottom moved, rotated and scaled.
    [[nodiscard]] double unlike() const;

private:
    struct SideCurve {
        std::vector<Vec3> points;
        std::vector<double> arc;
        [[nodiscard]] Vec3 at(double f) const;
        [[nodiscard]] Vec3 tangent(double f) const;
    };
    [[nodiscard]] Eigen::Matrix3d frame(double t) const;
    [[nodiscard]] bool is_bent_seam() const;
    void carry_frame();

    SideCurve bottom_, right_, top_, left_;
    Eigen::Matrix3d first_, last_;
    std::vector<Eigen::Quaterniond> carried_; ///< frames at equidistant points of a bent seam; else empty
    double twist_ = 0;                        ///< twist of the frame about the seam, at the top [radians]
    bool turns_ = true;
};

/// Grid of points on the patch of four sides, numbered and spaced as by `transfinite()`.
/// @pre  opposite sides have equal numbers of points, corners are bit-identical.
std::vector<Vec3> swept_grid(std::span<const Vec3> bottom, std::span<const Vec3> right,
                             std::span<const Vec3> top, std::span<const Vec3> left);

} // namespace lacuna::geometry
