// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Transfinite interpolation of four sides that turns with them: for walls that run along a bend.
///
/// A Coons patch adds up displacements in fixed axes, so half a tube along a bent path comes out squeezed
/// where the path has turned away from both ends. Here what the bottom and top deviate from their chords is
/// expressed in a frame that follows the chord between left and right and the way the sides lead: x(s, t) =
/// (1−s) left(t) + s right(t) + size(t) F(t) [(1−t) b(s) + t e(s)], b and e the deviations of bottom and
/// top in the frames F(0) and F(1), over their lengths. All four sides are met; where the frame does not
/// turn and the lengths agree it is the Coons patch.
///
/// Round a bent seam (left and right are one line, bottom and top close) there is no chord. The frame is then
/// moved along the seam with the least turn (rotation-minimising), plus an even twist about it that brings
/// the bottom's deviations nearest to the top's: a ring about an arc gives its torus.
class SweptPatch {
public:
    /// Sides as polylines: bottom and top from left to right, left and right from bottom to top, corners
    /// shared.
    SweptPatch(std::span<const Vec3> bottom, std::span<const Vec3> right, std::span<const Vec3> top,
               std::span<const Vec3> left);

    /// The point at shares of the sides' lengths, both in [0, 1].
    [[nodiscard]] Vec3 operator()(double s, double t) const;

    /// False where left and right run so close together that no chord gives a frame, and they are no bent
    /// seam: a plain Coons patch then.
    [[nodiscard]] bool turns() const { return turns_; }

    /// How far the bottom's deviations from its chord are off the top's, in the frames at either end and over
    /// their lengths: 0 where the patch is the bottom moved, turned and scaled.
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
    std::vector<Eigen::Quaterniond> carried_; ///< frames at even places of a bent seam; else none
    double twist_ = 0;                        ///< of the top's frame about the seam, beyond the moved one
    bool turns_ = true;
};

/// Grid of points on the patch of four sides, numbered and spaced as by `transfinite()`.
/// @pre  opposite sides have as many points as each other, corners are equal to the bit.
std::vector<Vec3> swept_grid(std::span<const Vec3> bottom, std::span<const Vec3> right,
                             std::span<const Vec3> top, std::span<const Vec3> left);

} // namespace lacuna::geometry
