// SPDX-License-Identifier: MIT
#pragma once

/// The quads around each point of a mesh with fixed connections; for connections that change see `QuadNet`.

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/types.h>
#include <lacuna/quads/detail/corner_sine.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace lacuna::quads {

/// A quad seen from one of its points.
///
///     before---across
///       |        |
///     point ---- next
struct Spoke {
    Index next, across, before;
};

/// The quads around every point, in compressed rows, each row ordered by quad.
class Stars {
public:
    Stars(std::size_t points, std::span<const Quad> quads) : start_(points + 1, 0)
    {
        for (const Quad& quad : quads) {
            for (const Index p : quad) ++start_[index(p) + 1];
        }
        for (std::size_t p = 0; p < points; ++p) start_[p + 1] += start_[p];
        spokes_.resize(index(start_.back()));
        std::vector<Index> end(start_.begin(), start_.end() - 1);
        for (const Quad& quad : quads) {
            for (std::size_t k = 0; k < 4; ++k)
                spokes_[index(end[index(quad[k])]++)] = {quad[(k + 1) % 4], quad[(k + 2) % 4],
                                                         quad[(k + 3) % 4]};
        }
    }
    [[nodiscard]] std::span<const Spoke> operator[](std::size_t p) const
    {
        return {spokes_.data() + start_[p], index(start_[p + 1] - start_[p])};
    }

private:
    std::vector<Index> start_;
    std::vector<Spoke> spokes_;
};

/// The number of quads at each point.
inline std::vector<Index> valences(std::span<const Quad> quads, std::size_t points)
{
    std::vector<Index> valence(points, 0);
    for (const Quad& quad : quads)
        for (const Index p : quad) ++valence[index(p)];
    return valence;
}

/// The smallest sine of the corners of the quads around a point if the point were at `x`; at most 1.
inline double worst_quad(std::span<const Vec2> points, std::span<const Spoke> star, const Vec2& x)
{
    double worst = 1;
    for (const Spoke& spoke : star)
        worst = std::min(worst, least_sine(x, points[index(spoke.next)], points[index(spoke.across)],
                                           points[index(spoke.before)]));
    return worst;
}

/// The shortest side at a point if the point were at `x`.
inline double shortest_side(std::span<const Vec2> points, std::span<const Spoke> star, const Vec2& x)
{
    double squared = kInfinity;
    for (const Spoke& spoke : star) {
        squared = std::min({squared, (points[index(spoke.next)] - x).squaredNorm(),
                            (points[index(spoke.before)] - x).squaredNorm()});
    }
    return std::sqrt(squared);
}

/// If a point is moved to improve its worst sine, its shortest side keeps at least this share of its initial
/// length. Sines do not depend on lengths: a very thin rectangle has the same sines as a square. Without this
/// limit, sides shrank to a millionth of the length of their neighbours. A higher value prevents more
/// improvements; a lower value allows shorter edges.
inline constexpr double kShortestKept = 0.25;

/// For each point, the length that its shortest side must keep (`kShortestKept`). 0 for the first `fixed`
/// points and for points without quads.
inline std::vector<double> sides_to_keep(std::span<const Vec2> points, const Stars& stars, std::size_t fixed)
{
    std::vector<double> least(points.size(), 0);
    for (std::size_t p = fixed; p < points.size(); ++p)
        if (!stars[p].empty()) least[p] = kShortestKept * shortest_side(points, stars[p], points[p]);
    return least;
}

/// The smallest sine, at most 1, of the corners that change if a point moves to `x`. If this sine does not
/// exceed `floor`, the result is any number up to `floor`: the search stops at the first corner whose sine
/// does not exceed the floor. In most trials this is the same corner as in the previous trial.
/// @param first  position in the star at which the search begins. On return, the position at which the
///         search stopped, so that the next trial can begin there.
inline double least_sine_above(std::span<const Vec2> points, std::span<const Spoke> star, const Vec2& x,
                               double floor, std::size_t& first)
{
    double least = 1;
    for (std::size_t k = 0, i = first; k < star.size(); ++k, i = i + 1 < star.size() ? i + 1 : 0) {
        const Spoke& spoke = star[i];
        const Vec2 &n = points[index(spoke.next)], &o = points[index(spoke.across)],
                   &r = points[index(spoke.before)];
        const Vec2 a = n - x, b = r - x, c = o - n, d = o - r;
        const double aa = a.squaredNorm(), bb = b.squaredNorm(), cc = c.squaredNorm(), dd = d.squaredNorm();
        const double ab = cross(a, b), ac = cross(a, c), db = cross(d, b);
        // A test without square roots and divisions, for corners clearly below the floor.
        const double squared = (1 - kRoundoff) * floor * floor;
        const bool below = floor >= 0 && (std::min({ab, ac, db}) <= 0 || ab * ab < squared * aa * bb ||
                                          ac * ac < squared * aa * cc || db * db < squared * dd * bb);
        if (!below) {
            least = std::min({least, corner_sine(ab, std::sqrt(aa * bb)), corner_sine(ac, std::sqrt(aa * cc)),
                              corner_sine(db, std::sqrt(dd * bb))});
        }
        if (!below && least > floor) continue;
        first = i;
        return std::min(least, floor);
    }
    return least;
}

/// As `least_sine_above()`, without a floor.
inline double least_sine(std::span<const Vec2> points, std::span<const Spoke> star, const Vec2& x)
{
    std::size_t first = 0;
    return least_sine_above(points, star, x, -kInfinity, first);
}

} // namespace lacuna::quads
