// SPDX-License-Identifier: MIT
#pragma once

/// What the smoothing of quads in the plane shares; only sources of this folder include it.

#include <lacuna/core/types.h>

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A quad as one of its points sees it.
///
///     before---across
///       |        |
///     point ---- next
struct Spoke {
    Index next, across, before;
};

/// The quads round every point.
class Stars {
public:
    Stars(std::size_t points, std::span<const Quad> quads) : start_(points + 1, 0)
    {
        for (const Quad& quad : quads) {
            for (const Index p : quad) ++start_[static_cast<std::size_t>(p) + 1];
        }
        for (std::size_t p = 0; p < points; ++p) start_[p + 1] += start_[p];
        spokes_.resize(static_cast<std::size_t>(start_.back()));
        std::vector<Index> place(start_.begin(), start_.end() - 1);
        for (const Quad& quad : quads) {
            for (std::size_t k = 0; k < 4; ++k) {
                const auto to = static_cast<std::size_t>(place[static_cast<std::size_t>(quad[k])]++);
                spokes_[to] = {quad[(k + 1) % 4], quad[(k + 2) % 4], quad[(k + 3) % 4]};
            }
        }
    }
    [[nodiscard]] std::span<const Spoke> operator[](std::size_t p) const
    {
        return {spokes_.data() + start_[p], static_cast<std::size_t>(start_[p + 1] - start_[p])};
    }

private:
    std::vector<Index> start_;
    std::vector<Spoke> spokes_;
};

/// Least sine of the corners that change when a point moves to `x`.
inline double least_sine(std::span<const Vec2> points, std::span<const Spoke> star, const Vec2& x)
{
    double least = 1;
    for (const Spoke& spoke : star) {
        const Vec2& n = points[static_cast<std::size_t>(spoke.next)];
        const Vec2& o = points[static_cast<std::size_t>(spoke.across)];
        const Vec2& r = points[static_cast<std::size_t>(spoke.before)];
        const Vec2 a = n - x, b = r - x, c = o - n, d = o - r;
        const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm(), dd = d.squaredNorm();
        const auto sine = [](double det, double both) { return both > 0 ? det / std::sqrt(both) : 0.0; };
        least = std::min({least, sine(a.x() * b.y() - a.y() * b.x(), aa * bb),
                          sine(a.x() * c.y() - a.y() * c.x(), aa * cc),
                          sine(d.x() * b.y() - d.y() * b.x(), dd * bb)});
    }
    return least;
}

/// Open folded quads by moving points that are not fixed (Garanzha et al. 2021, in two dimensions). @return true when
/// no corner of any quad is left that is not positive, but those of three fixed points. Where it fails the points are as they were.
bool untangle_plane(std::vector<Vec2>& points, std::span<const Quad> quads, const std::vector<char>& fixed,
                    const std::vector<double>& size);

} // namespace lacuna::quads
