// SPDX-License-Identifier: MIT
#pragma once

/// The energy minimised by smoothing in the plane.

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/vector_code.h>
#include <lacuna/quads/detail/plane_stars.h>

#include <algorithm>
#include <vector>

namespace lacuna::quads {

/// Target areas of the quads around each point.
struct TargetAreas {
    struct Target {
        double area = 0, inverse = 0; ///< target area and its inverse; both are 0 if there is no target
    };
    double weight = 0;
    std::vector<Target> asked; ///< for each point; empty: no targets
};

/// Energy of the quads around one point, with its gradient and curvature as functions of the point's
/// position.
///
/// The energy is the sum of f², with f = (|a|² + |b|²) / (2 det), over the corners that change if the point
/// moves. Here a and b are the two sides at a corner, and det = a × b. The square gives bad corners more
/// weight. If there is a target area A, a term w (det / A + A / det) / 2 is added for each of these corners,
/// where w is `TargetAreas::weight`.
struct StarEnergy {
    double value = 0;
    Vec2 slope{0, 0};
    double xx = 0, xy = 0, yy = 0;
    double sides = 0; ///< sum of the squared lengths of the sides at the point, two sides for each quad
};

/// One number for each of four quads.
using Lanes = Four;

LACUNA_INLINE double sum_of(const Lanes& v) { return (v[0] + v[2]) + (v[1] + v[3]); }
LACUNA_INLINE bool all_positive(const Lanes& a, const Lanes& b, const Lanes& c)
{
    const auto positive = (a > 0) & (b > 0) & (c > 0);
    return (positive[0] & positive[1] & positive[2] & positive[3]) != 0;
}

/// Up to four quads of a star, computed together by vector instructions.
///
/// All functions are inlined into the caller and compiled for the caller's processor. No vector is passed by
/// value, because the calling convention depends on the processor.
class SpokeLanes {
public:
    static constexpr std::size_t kLanes = 4;

    /// @param p  the centre of the star
    LACUNA_INLINE void set(std::span<const Vec2> points, std::span<const Spoke> star, std::size_t first,
                           std::size_t p, const TargetAreas& areas)
    {
        const std::size_t last = star.size() - 1;
        const auto spoke = [&](std::size_t k) -> const Spoke& { return star[std::min(first + k, last)]; };
        const Spoke &s0 = spoke(0), &s1 = spoke(1), &s2 = spoke(2), &s3 = spoke(3);
        const auto at = [&](Index i) -> const Vec2& { return points[index(i)]; };
        nx_ = Lanes{at(s0.next).x(), at(s1.next).x(), at(s2.next).x(), at(s3.next).x()};
        ny_ = Lanes{at(s0.next).y(), at(s1.next).y(), at(s2.next).y(), at(s3.next).y()};
        ox_ = Lanes{at(s0.across).x(), at(s1.across).x(), at(s2.across).x(), at(s3.across).x()};
        oy_ = Lanes{at(s0.across).y(), at(s1.across).y(), at(s2.across).y(), at(s3.across).y()};
        rx_ = Lanes{at(s0.before).x(), at(s1.before).x(), at(s2.before).x(), at(s3.before).x()};
        ry_ = Lanes{at(s0.before).y(), at(s1.before).y(), at(s2.before).y(), at(s3.before).y()};
        const auto counts = [&](std::size_t k) { return first + k <= last ? 1.0 : 0.0; };
        counts_ = Lanes{counts(0), counts(1), counts(2), counts(3)};
        has_area_ = !areas.asked.empty();
        if (!has_area_) return;
        const auto asked = [&](Index i) -> const TargetAreas::Target& { return areas.asked[index(i)]; };
        const auto &n0 = asked(s0.next), &n1 = asked(s1.next), &n2 = asked(s2.next), &n3 = asked(s3.next);
        const auto &r0 = asked(s0.before), &r1 = asked(s1.before), &r2 = asked(s2.before),
                   &r3 = asked(s3.before);
        area_n_ = Lanes{n0.area, n1.area, n2.area, n3.area};
        inverse_n_ = Lanes{n0.inverse, n1.inverse, n2.inverse, n3.inverse};
        area_r_ = Lanes{r0.area, r1.area, r2.area, r3.area};
        inverse_r_ = Lanes{r0.inverse, r1.inverse, r2.inverse, r3.inverse};
        area_p_ = Lanes{} + areas.asked[p].area;
        inverse_p_ = Lanes{} + areas.asked[p].inverse;
    }

    /// Add the energy of these quads, and the derivatives of this energy. @return  false if a corner is
    /// folded
    LACUNA_INLINE bool add_to(StarEnergy& around, const Vec2& x, double weight) const
    {
        const Lanes ax = nx_ - x.x(), ay = ny_ - x.y(), bx = rx_ - x.x(), by = ry_ - x.y();
        const Lanes cx = ox_ - nx_, cy = oy_ - ny_, dx = ox_ - rx_, dy = oy_ - ry_;
        const Lanes aa = ax * ax + ay * ay, bb = bx * bx + by * by;
        const Lanes det_p = ax * by - ay * bx, det_n = ax * cy - ay * cx, det_r = dx * by - dy * bx;
        if (!all_positive(det_p, det_n, det_r)) return false;
        Sums sums;
        sums.add(det_p, ay - by, bx - ax, aa + bb, -2 * (ax + bx), -2 * (ay + by), 4);
        if (has_area_) sums.ask(area_p_, inverse_p_, weight, ay - by, bx - ax);
        sums.add(det_n, -cy, cx, aa + cx * cx + cy * cy, -2 * ax, -2 * ay, 2);
        if (has_area_) sums.ask(area_n_, inverse_n_, weight, -cy, cx);
        sums.add(det_r, dy, -dx, bb + dx * dx + dy * dy, -2 * bx, -2 * by, 2);
        if (has_area_) sums.ask(area_r_, inverse_r_, weight, dy, -dx);
        around.value += sum_of(sums.value * counts_);
        around.slope.x() += sum_of(sums.gx * counts_);
        around.slope.y() += sum_of(sums.gy * counts_);
        around.xx += sum_of(sums.xx * counts_);
        around.xy += sum_of(sums.xy * counts_);
        around.yy += sum_of(sums.yy * counts_);
        around.sides += sum_of((aa + bb) * counts_);
        return true;
    }

    /// Add only the energy. @return  false if a corner is folded, or if the square of a corner's sine is less
    /// than `least`
    LACUNA_INLINE bool add_to(double& value, const Vec2& x, double weight, double least) const
    {
        Corners corners;
        find_corners(x, corners);
        const auto& [aa, bb, cc, dd, det_p, det_n, det_r] = corners;
        if (!all_positive(det_p, det_n, det_r)) return false;
        if (least > 0) {
            const Lanes over_p = det_p * det_p - least * aa * bb, over_n = det_n * det_n - least * aa * cc,
                        over_r = det_r * det_r - least * bb * dd;
            const auto below = (over_p < 0) | (over_n < 0) | (over_r < 0);
            if ((below[0] | below[1] | below[2] | below[3]) != 0) return false;
        }
        const Lanes ip = 1 / det_p, in = 1 / det_n, ir = 1 / det_r;
        const Lanes fp = (aa + bb) * ip, fn = (aa + cc) * in, fr = (bb + dd) * ir;
        Lanes sum = (fp * fp + fn * fn + fr * fr) / 4;
        if (has_area_)
            sum += (weight / 2) * (det_p * inverse_p_ + area_p_ * ip + det_n * inverse_n_ + area_n_ * in +
                                   det_r * inverse_r_ + area_r_ * ir);
        value += sum_of(sum * counts_);
        return true;
    }

    /// Add `weight` times (f - 1) for each corner that changes if the point moves. Stop after the quad with
    /// which the value reaches `bound`.
    LACUNA_INLINE void add_shapes(double& value, const Vec2& x, double weight, double bound) const
    {
        Corners corners;
        find_corners(x, corners);
        const auto& [aa, bb, cc, dd, det_p, det_n, det_r] = corners;
        const Lanes shape = weight * (((aa + bb) / (2 * det_p) - 1) + ((aa + cc) / (2 * det_n) - 1) +
                                      ((bb + dd) / (2 * det_r) - 1));
        for (std::size_t k = 0; k < kLanes && counts_[k] != 0 && value < bound; ++k) value += shape[k];
    }

private:
    /// Squared lengths of the sides of a quad, starting with the two sides at the point, and twice the areas
    /// at the corners that change.
    struct Corners {
        Lanes aa, bb, cc, dd, det_p, det_n, det_r;
    };

    LACUNA_INLINE void find_corners(const Vec2& x, Corners& corners) const
    {
        const Lanes ax = nx_ - x.x(), ay = ny_ - x.y(), bx = rx_ - x.x(), by = ry_ - x.y();
        const Lanes cx = ox_ - nx_, cy = oy_ - ny_, dx = ox_ - rx_, dy = oy_ - ry_;
        corners.aa = ax * ax + ay * ay;
        corners.bb = bx * bx + by * by;
        corners.cc = cx * cx + cy * cy;
        corners.dd = dx * dx + dy * dy;
        corners.det_p = ax * by - ay * bx;
        corners.det_n = ax * cy - ay * cx;
        corners.det_r = dx * by - dy * bx;
    }

    struct Sums {
        Lanes value{}, gx{}, gy{}, xx{}, xy{}, yy{};
        Lanes det, over;

        /// Add f² of a corner, with f = sum / (2 det).
        /// @param d    determinant, a linear function of the point with the gradient `dx`, `dy`
        /// @param sum  sum of the squared lengths of the corner's sides, with the gradient `sx`, `sy` and the
        ///         second derivative `curve` in x and in y
        LACUNA_INLINE void add(const Lanes& d, const Lanes& dx, const Lanes& dy, const Lanes& sum,
                               const Lanes& sx, const Lanes& sy, double curve)
        {
            det = d;
            over = 1 / det;
            const Lanes f = 0.5 * sum * over;
            const Lanes fx = (0.5 * sx - f * dx) * over, fy = (0.5 * sy - f * dy) * over;
            value += f * f;
            gx += 2 * f * fx;
            gy += 2 * f * fy;
            xx += 2 * (f * (0.5 * curve - 2 * fx * dx) * over + fx * fx);
            yy += 2 * (f * (0.5 * curve - 2 * fy * dy) * over + fy * fy);
            xy += 2 * (fx * fy - f * (fx * dy + fy * dx) * over);
        }

        /// Add the size term of the corner that `add()` added last.
        LACUNA_INLINE void ask(const Lanes& area, const Lanes& inverse, double weight, const Lanes& dx,
                               const Lanes& dy)
        {
            const Lanes v = area * over;
            const Lanes first = (weight / 2) * (inverse - v * over), second = weight * v * over * over;
            value += (weight / 2) * (det * inverse + v);
            gx += first * dx;
            gy += first * dy;
            xx += second * dx * dx;
            xy += second * dx * dy;
            yy += second * dy * dy;
        }
    };

    Lanes nx_, ny_, ox_, oy_, rx_, ry_;
    Lanes counts_; ///< 1 for a quad; 0 in a lane that only repeats the last quad
    Lanes area_p_, inverse_p_, area_n_, inverse_n_, area_r_, inverse_r_;
    bool has_area_;
};

/// The star of one point. It is loaded once and can be evaluated several times.
class StarLanes {
public:
    /// @pre the star is not empty
    LACUNA_INLINE void set(std::span<const Vec2> points, std::span<const Spoke> star, std::size_t p,
                           const TargetAreas& areas)
    {
        count_ = (star.size() + SpokeLanes::kLanes - 1) / SpokeLanes::kLanes;
        if (count_ > lanes_.size()) lanes_.resize(count_);
        for (std::size_t i = 0; i < count_; ++i)
            lanes_[i].set(points, star, i * SpokeLanes::kLanes, p, areas);
    }

    /// Compute the energy and its derivatives. @return  false if a corner is folded
    LACUNA_INLINE bool differentiate(const Vec2& x, double weight, StarEnergy& around) const
    {
        around = {};
        for (std::size_t i = 0; i < count_; ++i) {
            if (!lanes_[i].add_to(around, x, weight)) return false;
        }
        return true;
    }

    /// The energy. It is infinite if a corner is folded, or if the square of a corner's sine is less than
    /// `least`.
    LACUNA_INLINE double energy(const Vec2& x, double weight, double least) const
    {
        double value = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            if (!lanes_[i].add_to(value, x, weight, least)) return kInfinity;
        }
        return value;
    }

    /// As `SpokeLanes::add_shapes()`, for all quads of the star.
    LACUNA_INLINE void add_shapes(double& value, const Vec2& x, double weight, double bound) const
    {
        for (std::size_t i = 0; i < count_; ++i) lanes_[i].add_shapes(value, x, weight, bound);
    }

private:
    std::vector<SpokeLanes> lanes_{1};
    std::size_t count_ = 0;
};

} // namespace lacuna::quads
