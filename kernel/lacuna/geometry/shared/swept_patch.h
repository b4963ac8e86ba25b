// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Transfinite interpolation of four sides with a frame that rotates along them: for walls along a bend.
///
/// A Coons patch adds displacements in fixed axes. Half a tube along a bent path becomes too narrow where the
/// direction of the path differs from the directions at both ends. Here the deviations of bottom and top from
/// their chords are expressed in a frame F(t), spanned by the direction of the sides left and right and by
/// the chord between them:
///   x(s, t) = (1−s) left(t) + s right(t) + size(t) F(t) [(1−t) b(s) + t e(s)].
/// b and e are the deviations of bottom and top in the frames F(0) and F(1), divided by the lengths of bottom
/// and top; size(t) interpolates between these two lengths. The patch contains all four sides. If the frame
/// does not rotate and the lengths agree, the result is the Coons patch.
///
/// Around a bent seam (left and right coincide, bottom and top are closed) there is no chord. The frame then
/// moves along the seam with minimal rotation, plus a uniform twist for which the deviations of top and
/// bottom agree best. A circle swept along an arc gives the torus.
class SweptPatch {
public:
    /// Sides as polylines: bottom and top from left to right, left and right from bottom to top, with common
    /// corners.
    SweptPatch(std::span<const Vec3> bottom, std::span<const Vec3> right, std::span<const Vec3> top,
               std::span<const Vec3> left);

    /// The point at relative arc lengths of the sides, both in [0, 1].
    [[nodiscard]] Vec3 operator()(double s, double t) const;

    /// False if there is no frame, so that the patch is a Coons patch: left and right are too close together
    /// or run along the chord between them, and they are not a bent seam.
    [[nodiscard]] bool turns() const { return turns_; }

    /// Largest difference between the deviations of bottom and top from their chords. Each deviation is
    /// measured in the frame of its side and relative to the length of the side. 0 if the top is the bottom
    /// moved, rotated and scaled.
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
