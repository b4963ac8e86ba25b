// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/transfinite.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <limits>

namespace lacuna::geometry {

namespace {

/// Position of each point of a side in [0, 1].
template <class Point>
std::vector<double> parameters(std::span<const Point> side, bool by_arc_length)
{
    std::vector<double> result(side.size(), 0.0);
    for (std::size_t i = 1; by_arc_length && i < side.size(); ++i)
        result[i] = result[i - 1] + (side[i] - side[i - 1]).norm();
    const double total = result.back();
    const auto last = static_cast<double>(side.size() - 1);
    for (std::size_t i = 0; i < side.size(); ++i)
        result[i] = by_arc_length && total > 0 ? result[i] / total : static_cast<double>(i) / last;
    return result;
}

template <class Point>
void check_sides(std::span<const Point> bottom, std::span<const Point> right, std::span<const Point> top,
                 std::span<const Point> left)
{
    const auto fail = []<class... Arguments>(Format<sizeof...(Arguments)> format,
                                             const Arguments&... arguments) {
        throw InvalidInput(Message("geometry.transfinite_sides", format, arguments...)
                               .about("a transfinite grid cannot be made"));
    };
    if (bottom.size() != top.size() || left.size() != right.size())
        throw InvalidInput(
            Message("geometry.transfinite_sides",
                    "a transfinite grid cannot be made: opposite sides must have equal numbers of points; "
                    "found bottom {}, top {}, left {}, right {}",
                    found(bottom.size()), found(top.size()), found(left.size()), found(right.size()))
                .remedy("give opposite sides the same number of divisions"));
    if (bottom.size() < 2 || left.size() < 2) fail("each side needs at least two points");
    if (bottom.front() != left.front()) fail("the bottom and the left side do not start in the same point");
    if (bottom.back() != right.front()) fail("the bottom side does not end where the right one starts");
    if (top.front() != left.back()) fail("the top side does not start where the left one ends");
    if (top.back() != right.back()) fail("the top and the right side do not end in the same point");
}

/// `transfinite()`, in the plane or in space.
template <class Point>
std::vector<Point> coons_grid(std::span<const Point> bottom, std::span<const Point> right,
                              std::span<const Point> top, std::span<const Point> left,
                              const TransfiniteOptions& options)
{
    check_sides(bottom, right, top, left);
    const CoonsPatch<Point> patch(bottom, right, top, left, options);
    const std::size_t n = bottom.size() - 1, m = left.size() - 1;
    std::vector<Point> grid((n + 1) * (m + 1));
    for (std::size_t i = 0; i <= n; ++i) {
        grid[i] = bottom[i];
        grid[m * (n + 1) + i] = top[i];
    }
    for (std::size_t j = 0; j <= m; ++j) {
        grid[j * (n + 1)] = left[j];
        grid[j * (n + 1) + n] = right[j];
    }
    for (std::size_t j = 1; j < m; ++j) {
        for (std::size_t i = 1; i < n; ++i) {
            const Vec2 st = patch.crossing(i, i, j, j);
            grid[j * (n + 1) + i] = patch.blend(st, bottom[i], right[j], top[i], left[j]);
        }
    }
    return grid;
}

/// The point at a relative arc length of a side.
template <class Point>
Point point_on(std::span<const Point> side, const std::vector<double>& at, double share)
{
    auto i = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), share) - at.begin());
    i = std::clamp<std::size_t>(i, 1, at.size() - 1);
    const double gap = at[i] - at[i - 1];
    return side[i - 1] + (gap > 0 ? (share - at[i - 1]) / gap : 0) * (side[i] - side[i - 1]);
}

} // namespace

template <class Point>
CoonsPatch<Point>::CoonsPatch(std::span<const Point> bottom, std::span<const Point> right,
                              std::span<const Point> top, std::span<const Point> left,
                              const TransfiniteOptions& options)
    : bottom_{bottom, parameters(bottom, options.by_arc_length)},
      right_{right, parameters(right, options.by_arc_length)},
      top_{top, parameters(top, options.by_arc_length)},
      left_{left, parameters(left, options.by_arc_length)}
{
}

template <class Point>
Vec2 CoonsPatch<Point>::crossing(std::size_t i, std::size_t k, std::size_t l, std::size_t j) const
{
    const double s0 = bottom_.at[i], s1 = top_.at[k], t0 = left_.at[l], t1 = right_.at[j];
    const double ds = s1 - s0, dt = t1 - t0;
    const double determinant = 1 - ds * dt;
    // The determinant is 0 only if both lines are the same diagonal. Each of its points is then a solution;
    // take the middle.
    if (determinant <= std::numeric_limits<double>::epsilon()) return {0.5 * (s0 + s1), 0.5 * (t0 + t1)};
    return {(s0 + t0 * ds) / determinant, (t0 + s0 * dt) / determinant};
}

template <class Point>
Point CoonsPatch<Point>::blend(const Vec2& st, const Point& bottom, const Point& right, const Point& top,
                               const Point& left) const
{
    // Compute relative to one corner, to keep precision far from the origin.
    const Point& c0 = bottom_.points.front();
    const Point c1 = bottom_.points.back() - c0, c2 = top_.points.back() - c0, c3 = top_.points.front() - c0;
    const double s = st.x(), t = st.y();
    const Point across = (1 - t) * (bottom - c0) + t * (top - c0);
    const Point along = (1 - s) * (left - c0) + s * (right - c0);
    const Point corners = s * (1 - t) * c1 + s * t * c2 + (1 - s) * t * c3;
    return c0 + across + along - corners;
}

template <class Point>
Point CoonsPatch<Point>::operator()(const Vec2& st) const
{
    return blend(st, point_on(bottom_.points, bottom_.at, st.x()), point_on(right_.points, right_.at, st.y()),
                 point_on(top_.points, top_.at, st.x()), point_on(left_.points, left_.at, st.y()));
}

template class CoonsPatch<Vec2>;
template class CoonsPatch<Vec3>;

std::vector<Vec3> transfinite(std::span<const Vec3> bottom, std::span<const Vec3> right,
                              std::span<const Vec3> top, std::span<const Vec3> left,
                              const TransfiniteOptions& options)
{
    return coons_grid(bottom, right, top, left, options);
}

std::vector<Vec2> transfinite(std::span<const Vec2> bottom, std::span<const Vec2> right,
                              std::span<const Vec2> top, std::span<const Vec2> left,
                              const TransfiniteOptions& options)
{
    return coons_grid(bottom, right, top, left, options);
}

} // namespace lacuna::geometry
