// SPDX-License-Identifier: MIT
#include <lacuna/geometry/transfinite.h>

#include <lacuna/core/error.h>

#include <limits>
#include <string>

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

/// Crossing of the lines (s0, 0)–(s1, 1) and (0, t0)–(1, t1).
Vec2 crossing(double s0, double s1, double t0, double t1)
{
    const double ds = s1 - s0, dt = t1 - t0;
    const double determinant = 1 - ds * dt;
    // It vanishes only where both lines are the same diagonal; any place on it will do, the middle is fair.
    if (determinant <= std::numeric_limits<double>::epsilon()) return {0.5 * (s0 + s1), 0.5 * (t0 + t1)};
    return {(s0 + t0 * ds) / determinant, (t0 + s0 * dt) / determinant};
}

template <class Point>
void check_sides(std::span<const Point> bottom, std::span<const Point> right, std::span<const Point> top,
                 std::span<const Point> left)
{
    const auto fail = [](const std::string& what) {
        throw InvalidInput("geometry.transfinite_sides", "a transfinite grid cannot be laid: " + what);
    };
    if (bottom.size() != top.size() || left.size() != right.size())
        fail("opposite sides must have as many points as each other; found bottom " +
             std::to_string(bottom.size()) + ", top " + std::to_string(top.size()) + ", left " +
             std::to_string(left.size()) + ", right " + std::to_string(right.size()) +
             "; give opposite sides the same number of divisions");
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
    const std::size_t n = bottom.size() - 1, m = left.size() - 1;
    const std::vector<double> s_bottom = parameters(bottom, options.by_arc_length);
    const std::vector<double> s_top = parameters(top, options.by_arc_length);
    const std::vector<double> t_left = parameters(left, options.by_arc_length);
    const std::vector<double> t_right = parameters(right, options.by_arc_length);

    std::vector<Point> grid((n + 1) * (m + 1));
    for (std::size_t i = 0; i <= n; ++i) {
        grid[i] = bottom[i];
        grid[m * (n + 1) + i] = top[i];
    }
    for (std::size_t j = 0; j <= m; ++j) {
        grid[j * (n + 1)] = left[j];
        grid[j * (n + 1) + n] = right[j];
    }
    // Seen from one corner, sides far from the origin lose no digits to it.
    const Point c0 = bottom.front();
    const Point c1 = bottom.back() - c0, c2 = top.back() - c0, c3 = top.front() - c0;
    for (std::size_t j = 1; j < m; ++j) {
        for (std::size_t i = 1; i < n; ++i) {
            const Vec2 st = crossing(s_bottom[i], s_top[i], t_left[j], t_right[j]);
            const double s = st.x(), t = st.y();
            const Point across = (1 - t) * (bottom[i] - c0) + t * (top[i] - c0);
            const Point along = (1 - s) * (left[j] - c0) + s * (right[j] - c0);
            const Point corners = s * (1 - t) * c1 + s * t * c2 + (1 - s) * t * c3;
            grid[j * (n + 1) + i] = c0 + across + along - corners;
        }
    }
    return grid;
}

} // namespace

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
