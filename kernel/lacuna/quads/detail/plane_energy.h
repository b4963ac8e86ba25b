// SPDX-License-Identifier: MIT
#pragma once

/// The energy that smoothing in the plane lowers.

#include <lacuna/quads/detail/plane_stars.h>

#include <Eigen/Core>

namespace lacuna::quads {

/// Areas asked of the quads around each point.
struct TargetAreas {
    struct Target {
        double area = 0, inverse = 0; ///< 0: none is asked
    };
    double weight = 0;
    std::vector<Target> asked; ///< of each point; empty: of none
};

/// Energy of the quads around one point, with its gradient and curvature as the point moves.
///
/// The sum over the corners that change with the point of f², f = (|a|² + |b|²) / 2 det, the square so that
/// bad corners count for more; and where an area h² is asked, of (det / h² + h² / det) / 2.
struct StarEnergy {
    double value = 0;
    Vec2 slope{0, 0};
    double xx = 0, xy = 0, yy = 0;
    double sides = 0; ///< squared lengths of the sides at the point, each quad's two
};

/// Up to four quads of a star side by side, so that the processor takes two or four at a time.
class SpokeLanes {
public:
    using Lanes = Eigen::Array4d;
    static constexpr std::size_t kLanes = 4;

    SpokeLanes(std::span<const Vec2> points, std::span<const Spoke> star, std::size_t first, std::size_t p,
               const TargetAreas& areas)
        : has_area_(!areas.asked.empty())
    {
        const std::size_t last = star.size() - 1;
        for (std::size_t k = 0; k < kLanes; ++k) {
            const auto i = static_cast<Eigen::Index>(k);
            const Spoke& spoke = star[std::min(first + k, last)];
            const auto n = static_cast<std::size_t>(spoke.next), r = static_cast<std::size_t>(spoke.before);
            const Vec2 &pn = points[n], &po = points[index(spoke.across)], &pr = points[r];
            nx_[i] = pn.x();
            ny_[i] = pn.y();
            ox_[i] = po.x();
            oy_[i] = po.y();
            rx_[i] = pr.x();
            ry_[i] = pr.y();
            counts_[i] = first + k <= last ? 1 : 0;
            if (!has_area_) continue;
            area_n_[i] = areas.asked[n].area;
            inverse_n_[i] = areas.asked[n].inverse;
            area_r_[i] = areas.asked[r].area;
            inverse_r_[i] = areas.asked[r].inverse;
        }
        if (!has_area_) return;
        area_p_.setConstant(areas.asked[p].area);
        inverse_p_.setConstant(areas.asked[p].inverse);
    }

    /// Add the energy of these quads and its derivatives. @return false where a corner is folded
    bool add_to(StarEnergy& around, const Vec2& x, double weight) const
    {
        const Lanes ax = nx_ - x.x(), ay = ny_ - x.y(), bx = rx_ - x.x(), by = ry_ - x.y();
        const Lanes cx = ox_ - nx_, cy = oy_ - ny_, dx = ox_ - rx_, dy = oy_ - ry_;
        const Lanes aa = ax * ax + ay * ay, bb = bx * bx + by * by;
        const Lanes det_p = ax * by - ay * bx, det_n = ax * cy - ay * cx, det_r = dx * by - dy * bx;
        if (!(det_p.min(det_n).min(det_r).minCoeff() > 0)) return false;
        Sums sums;
        sums.add(det_p, ay - by, bx - ax, aa + bb, -2 * (ax + bx), -2 * (ay + by), 4);
        if (has_area_) sums.ask(area_p_, inverse_p_, weight, ay - by, bx - ax);
        sums.add(det_n, -cy, cx, aa + cx * cx + cy * cy, -2 * ax, -2 * ay, 2);
        if (has_area_) sums.ask(area_n_, inverse_n_, weight, -cy, cx);
        sums.add(det_r, dy, -dx, bb + dx * dx + dy * dy, -2 * bx, -2 * by, 2);
        if (has_area_) sums.ask(area_r_, inverse_r_, weight, dy, -dx);
        around.value += (sums.value * counts_).sum();
        around.slope.x() += (sums.gx * counts_).sum();
        around.slope.y() += (sums.gy * counts_).sum();
        around.xx += (sums.xx * counts_).sum();
        around.xy += (sums.xy * counts_).sum();
        around.yy += (sums.yy * counts_).sum();
        around.sides += ((aa + bb) * counts_).sum();
        return true;
    }

    /// Add the energy alone. @return false where a corner is folded, or its sine squared is less than `least`
    bool add_to(double& value, const Vec2& x, double weight, double least) const
    {
        const Lanes ax = nx_ - x.x(), ay = ny_ - x.y(), bx = rx_ - x.x(), by = ry_ - x.y();
        const Lanes cx = ox_ - nx_, cy = oy_ - ny_, dx = ox_ - rx_, dy = oy_ - ry_;
        const Lanes aa = ax * ax + ay * ay, bb = bx * bx + by * by, cc = cx * cx + cy * cy,
                    dd = dx * dx + dy * dy;
        const Lanes det_p = ax * by - ay * bx, det_n = ax * cy - ay * cx, det_r = dx * by - dy * bx;
        if (!(det_p.min(det_n).min(det_r).minCoeff() > 0)) return false;
        if (least > 0) {
            const Lanes over_p = det_p * det_p - least * aa * bb, over_n = det_n * det_n - least * aa * cc,
                        over_r = det_r * det_r - least * bb * dd;
            if (over_p.min(over_n).min(over_r).minCoeff() < 0) return false;
        }
        const Lanes ip = 1 / det_p, in = 1 / det_n, ir = 1 / det_r;
        const Lanes fp = (aa + bb) * ip, fn = (aa + cc) * in, fr = (bb + dd) * ir;
        Lanes sum = (fp * fp + fn * fn + fr * fr) / 4;
        if (has_area_)
            sum += (weight / 2) * (det_p * inverse_p_ + area_p_ * ip + det_n * inverse_n_ + area_n_ * in +
                                   det_r * inverse_r_ + area_r_ * ir);
        value += (sum * counts_).sum();
        return true;
    }

private:
    struct Sums {
        Lanes value = Lanes::Zero(), gx = Lanes::Zero(), gy = Lanes::Zero();
        Lanes xx = Lanes::Zero(), xy = Lanes::Zero(), yy = Lanes::Zero();
        Lanes det, over;

        /// f² of a corner, f = sum / 2 det.
        /// @param d    determinant; linear in the point, slope `dx`, `dy`
        /// @param sum  squared lengths of its sides; slope `sx`, `sy`, curvature `curve` in x and in y
        void add(const Lanes& d, const Lanes& dx, const Lanes& dy, const Lanes& sum, const Lanes& sx,
                 const Lanes& sy, double curve)
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

        /// The size of the corner added last.
        void ask(const Lanes& area, const Lanes& inverse, double weight, const Lanes& dx, const Lanes& dy)
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
    Lanes counts_; ///< 1, or 0 where a lane repeats the last quad
    Lanes area_p_, inverse_p_, area_n_, inverse_n_, area_r_, inverse_r_;
    bool has_area_;
};

/// The energy with its derivatives. @return false where a corner is folded
inline bool differentiate(std::span<const Vec2> points, std::span<const Spoke> star, std::size_t p,
                          const Vec2& x, const TargetAreas& areas, StarEnergy& around)
{
    around = {};
    for (std::size_t i = 0; i < star.size(); i += SpokeLanes::kLanes) {
        if (!SpokeLanes(points, star, i, p, areas).add_to(around, x, areas.weight)) return false;
    }
    return true;
}

/// The energy alone; infinite where a corner is folded, or its sine squared is less than `least`.
inline double energy_around(std::span<const Vec2> points, std::span<const Spoke> star, std::size_t p,
                            const Vec2& x, const TargetAreas& areas, double least)
{
    double value = 0;
    for (std::size_t i = 0; i < star.size(); i += SpokeLanes::kLanes) {
        if (!SpokeLanes(points, star, i, p, areas).add_to(value, x, areas.weight, least))
            return std::numeric_limits<double>::infinity();
    }
    return value;
}

} // namespace lacuna::quads
