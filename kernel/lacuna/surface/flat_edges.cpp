// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/flat_edges.h>

#include <algorithm>
#include <cmath>

namespace lacuna::surface {

Closest closest_on(const std::vector<Vec2>& line, const std::vector<double>& at, const Vec2& p)
{
    Closest best;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 d = line[i + 1] - line[i];
        const double length2 = d.squaredNorm();
        const double f = length2 > 0 ? std::clamp((p - line[i]).dot(d) / length2, 0.0, 1.0) : 0;
        const Vec2 place = line[i] + f * d;
        if ((p - place).norm() >= best.distance) continue;
        best = {(p - place).norm(), at[i] + f * (at[i + 1] - at[i]), place};
    }
    return best;
}

std::optional<Vec2> crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d)
{
    const Vec2 u = b - a, v = d - c, w = c - a;
    const double turn = u.x() * v.y() - u.y() * v.x();
    if (std::abs(turn) <= 1e-14 * u.norm() * v.norm()) return std::nullopt;
    const double s = (w.x() * v.y() - w.y() * v.x()) / turn, t = (w.x() * u.y() - w.y() * u.x()) / turn;
    if (s < 0 || s > 1 || t < 0 || t > 1) return std::nullopt;
    return Vec2(s, t);
}

} // namespace lacuna::surface
