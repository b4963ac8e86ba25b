// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Geometry>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Transfinite interpolation between four sides, with a frame that rotates from bottom to top: for walls
/// along a bend.
///
/// A Coons patch adds displacements in fixed axes. On half a tube along a bent path, it is therefore too
/// narrow where the path has another direction than at both ends. Here these displacements rotate with the
/// path. At each t, the frame F(t) is spanned by the direction of the sides left and right, and by the chord
/// from left(t) to right(t). The point is
///   x(s, t) = (1−s) left(t) + s right(t) + F(t) [(1−t) b(s) + t e(s)].
/// b is the deviation of the bottom from its chord, in the frame F(0). e is the same for the top, in the
/// frame F(1). The patch contains all four sides. If the frame does not rotate, the result is the Coons
/// patch, which is ruled between straight sides.
///
/// If left and right coincide (a seam) and are bent, bottom and top are closed, and there is no chord. The
/// frame then moves along the seam with minimal rotation, plus a uniform twist for which the deviations of
/// bottom and top agree best. A circle swept along an arc gives the torus.
class SweptPatch {
public:
    /// Sides as polylines: bottom and top from left to right, left and right from bottom to top, with common
    /// corners.
    SweptPatch(std::span<const Vec3> bottom, std::span<const Vec3> right, std::span<const Vec3> top,
               std::span<const Vec3> left);

    /// The point at relative arc lengths of the sides, both in [0, 1].
    [[nodiscard]] Vec3 operator()(double s, double t) const;

    /// Whether the patch has a frame. Without a frame it is a Coons patch. This is so if left and right are
    /// not a bent seam, and are too close together or parallel to the chord between them.
    [[nodiscard]] bool turns() const { return turns_; }

    /// Largest difference |b(s) − e(s)| between the relative deviations of bottom and top from their chords
    /// [-]. 0 if the top is the bottom moved, rotated and scaled.
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
