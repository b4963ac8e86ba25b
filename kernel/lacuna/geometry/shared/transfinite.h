// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::geometry {

/// Options of `transfinite()`.
struct TransfiniteOptions {
    /// The parameter of a point on a side. True: its relative arc length, so that graded sides give a graded
    /// grid. False: its index divided by the number of segments.
    bool by_arc_length = true;
};

/// The map of `transfinite()` from the unit square, in the plane (`Vec2`) or in space (`Vec3`).
template <class Point>
class CoonsPatch {
public:
    /// @param bottom, right, top, left as for `transfinite()`; kept by reference. Opposite sides may have
    ///                                  different numbers of points.
    CoonsPatch(std::span<const Point> bottom, std::span<const Point> right, std::span<const Point> top,
               std::span<const Point> left, const TransfiniteOptions& options = {});

    /// Relative arc length of a side at one of its points, in [0, 1].
    [[nodiscard]] double bottom(std::size_t i) const { return bottom_.at[i]; }
    [[nodiscard]] double right(std::size_t j) const { return right_.at[j]; }
    [[nodiscard]] double top(std::size_t k) const { return top_.at[k]; }
    [[nodiscard]] double left(std::size_t l) const { return left_.at[l]; }
    /// Where in the unit square the line from bottom point i to top point k crosses the line from left point
    /// l to right point j.
    [[nodiscard]] Vec2 crossing(std::size_t i, std::size_t k, std::size_t l, std::size_t j) const;
    /// The Coons formula at (s, t), for given points on the four sides.
    [[nodiscard]] Point blend(const Vec2& st, const Point& bottom, const Point& right, const Point& top,
                              const Point& left) const;
    /// The point at (s, t); sides are interpolated linearly between their points.
    [[nodiscard]] Point operator()(const Vec2& st) const;

private:
    struct PatchSide {
        std::span<const Point> points;
        std::vector<double> at; ///< relative arc length of each point
    };
    PatchSide bottom_, right_, top_, left_;
};

/// Grid of points interpolated between four sides in space or in the plane: bilinear Coons interpolation.
///
///         top ─▶
///      3 ─────── 2        Bottom and top run from left to right, n + 1 points each; left and right
///   ▲  │         │  ▲     from bottom to top, m + 1 points each. Neighbouring sides share their
/// left │         │ right  corner points.
///      0 ─────── 1
///        bottom ─▶
///
/// Let S be the relative arc length of a side's points, and c0 … c3 the corners. In the unit square, node
/// (i, j) is at the intersection (s, t) of two lines: from S_bottom(i) to S_top(i), and from S_left(j) to
/// S_right(j). Its position is
///   x = (1−t) bottom_i + t top_i + (1−s) left_j + s right_j
///       − (1−s)(1−t) c0 − s(1−t) c1 − s t c2 − (1−s) t c3.
/// Each side therefore has more weight at the nodes near it, and a grid between sides with equal spacing has
/// the same spacing. On a side of zero length (the tip of a triangle), S is the index of the point divided by
/// the number of segments.
///
/// @return (m + 1) × (n + 1) points, row by row from the bottom: node (i, j) at j * (n + 1) + i.
/// @post   the points of the sides are returned bit for bit; straight sides with equal spacing give the
///         bilinear grid (affine for a parallelogram) up to rounding.
/// @throw InvalidInput "geometry.transfinite_sides"  opposite sides have different numbers of points, a side
///         has fewer than two points, or neighbouring sides do not share their corner.
std::vector<Vec3> transfinite(std::span<const Vec3> bottom, std::span<const Vec3> right,
                              std::span<const Vec3> top, std::span<const Vec3> left,
                              const TransfiniteOptions& options = {});
std::vector<Vec2> transfinite(std::span<const Vec2> bottom, std::span<const Vec2> right,
                              std::span<const Vec2> top, std::span<const Vec2> left,
                              const TransfiniteOptions& options = {});

} // namespace lacuna::geometry
