// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// The map of `transfinite()` from the unit square, in the plane (`Vec2`) or in space (`Vec3`).
template <class Point>
class CoonsPatch {
public:
    /// @param bottom, right, top, left as `transfinite()` takes them; kept by reference. Opposite sides may
    ///                                  differ in number of points.
    CoonsPatch(std::span<const Point> bottom, std::span<const Point> right, std::span<const Point> top,
               std::span<const Point> left);

    /// The running length along a side at one of its points, scaled to [0, 1].
    [[nodiscard]] double bottom(std::size_t i) const { return bottom_.at[i]; }
    [[nodiscard]] double right(std::size_t j) const { return right_.at[j]; }
    [[nodiscard]] double top(std::size_t k) const { return top_.at[k]; }
    [[nodiscard]] double left(std::size_t l) const { return left_.at[l]; }
    /// Where in the unit square the line from bottom point i to top point k crosses that from left point l to
    /// right point j.
    [[nodiscard]] Vec2 crossing(std::size_t i, std::size_t k, std::size_t l, std::size_t j) const;
    /// The Coons formula at (s, t), given the four points on the sides.
    [[nodiscard]] Point blend(const Vec2& st, const Point& bottom, const Point& right, const Point& top,
                              const Point& left) const;
    /// The point at (s, t); sides are taken as straight between their points.
    [[nodiscard]] Point operator()(const Vec2& st) const;

private:
    struct PatchSide {
        std::span<const Point> points;
        std::vector<double> at; ///< running length, scaled to [0, 1]
    };
    PatchSide bottom_, right_, top_, left_;
};

/// Grid of points spanned by four sides in space or in the plane: bilinear Coons interpolation.
///
///         top ─▶
///      3 ─────── 2        Bottom and top run from left to right, n + 1 points each; left and right
///   ▲  │         │  ▲     from bottom to top, m + 1 points each. Neighbouring sides share their
/// left │         │ right  corner points.
///      0 ─────── 1
///        bottom ─▶
///
/// With S the running length along a side scaled to [0, 1], the node (i, j) stands where the straight lines
/// that join S_bottom(i) to S_top(i) and S_left(j) to S_right(j) cross in the unit square, at (s, t); then
///   x = (1−t) bottom_i + t top_i + (1−s) left_j + s right_j
///       − (1−s)(1−t) c0 − s(1−t) c1 − s t c2 − (1−s) t c3.
/// So the two sides of each pair weigh in as the node is near to them, and sides that agree give their own
/// spacing. A side of no length (a triangle's tip) counts its points instead.
///
/// @return (m + 1) × (n + 1) points, row by row from the bottom: node (i, j) at j * (n + 1) + i.
/// @post   the points of the sides come back bit for bit; straight sides spaced alike give the bilinear
///         (for a parallelogram the affine) grid to rounding.
/// @throw  InvalidInput "geometry.transfinite_sides"  opposite sides differ in number of points, a side has
///         fewer than two, or neighbouring sides do not meet in the same point.
std::vector<Vec3> transfinite(std::span<const Vec3> bottom, std::span<const Vec3> right,
                              std::span<const Vec3> top, std::span<const Vec3> left);
std::vector<Vec2> transfinite(std::span<const Vec2> bottom, std::span<const Vec2> right,
                              std::span<const Vec2> top, std::span<const Vec2> left);

} // namespace lacuna::geometry
