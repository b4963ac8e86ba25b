// SPDX-License-Identifier: MIT
#include <lacuna/quads/smooth_plane.h>

#include <lacuna/quads/detail/plane_energy.h>
#include <lacuna/quads/measure_plane.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::quads {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A move shorter than this share of the length of the sides around does not wake the neighbours.
constexpr double kStill = 0.02;
/// Steps are lengthened so much, but in the first sweep and the last: what is off over many quads is mended in a tenth of the
/// sweeps (measured: 1.5 and 1.7 need more, 1.9 overshoots between poor quads).
constexpr double kOverstep = 1.85;

struct Range {
    double least = 1;
    std::size_t folded = 0;
};

Range range_of(std::span<const Vec2> points, std::span<const Quad> quads)
{
    Range range;
    for (const Quad& quad : quads) {
        const double jacobian = scaled_jacobian(points, quad);
        range.least = std::min(range.least, jacobian);
        if (!(jacobian > 0)) ++range.folded;
    }
    return range;
}

class Smoother {
public:
    Smoother(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed,
             const SmoothPlaneOptions& options)
        : points_(points),
          quads_(quads),
          fixed_(fixed),
          options_(options),
          stars_(points.size(), quads),
          awake_(points.size(), 0)
    {
        const std::size_t first = std::min(std::max(fixed, options.still), points.size());
        std::fill(awake_.begin() + static_cast<std::ptrdiff_t>(first), awake_.end(), 1);
    }

    /// One step for every point that is awake. @return how many moved by more than next to nothing.
    std::size_t sweep(double floor, double overstep)
    {
        std::size_t moved = 0;
        Around here;
        for (std::size_t p = fixed_; p < points_.size(); ++p) {
            if (awake_[p] == 0) continue;
            awake_[p] = 0;
            const auto star = stars_[p];
            if (star.empty() || !look_around(points_, star, p, points_[p], areas_, here)) continue;
            const double det = here.xx * here.yy - here.xy * here.xy;
            if (!(det > 0)) continue;
            const Vec2 step(-(here.yy * here.slope.x() - here.xy * here.slope.y()) / det,
                            -(here.xx * here.slope.y() - here.xy * here.slope.x()) / det);
            const double side = here.sides / static_cast<double>(2 * star.size());
            double length = overstep;
            for (int attempt = 0; attempt<4; ++attempt, length = length> 1 ? 1 : length / 2) {
                const Vec2 to = points_[p] + length * step;
                const double least = floor * floor;
                double energy = energy_around(points_, star, p, to, areas_, least);
                if (energy > here.value && least > 0) { // where the sine is less already, it may stay so
                    const double sine = least_sine(points_, star, points_[p]);
                    if (sine < floor) energy = energy_around(points_, star, p, to, areas_, sine * sine);
                }
                if (energy > here.value) continue;
                points_[p] = to;
                if (length * length * step.squaredNorm() > kStill * kStill * side) {
                    ++moved;
                    wake(p, awake_);
                }
                break;
            }
        }
        return moved;
    }

    /// Move the points of poor quads to where the least sine around is largest; later only those with a neighbour
    /// that moved. @return whether any moved.
    bool raise(double floor)
    {
        if (restless_.empty()) restless_.assign(points_.size(), 1);
        std::vector<char> poor(points_.size(), 0);
        for (const Quad& quad : quads_) {
            if (scaled_jacobian(points_, quad) >= floor) continue;
            for (const Index p : quad) poor[static_cast<std::size_t>(p)] = 1;
        }
        bool moved = false;
        for (std::size_t p = fixed_; p < points_.size(); ++p) {
            if (poor[p] == 0 || restless_[p] == 0) continue;
            restless_[p] = 0;
            if (!raise_at(p)) continue;
            moved = true;
            wake(p, restless_);
        }
        return moved;
    }

    void ask_sizes()
    {
        if (!options_.size || !(options_.size_weight > 0)) return;
        areas_.weight = options_.size_weight;
        for (const Vec2& p : points_) {
            const double size = options_.size(p);
            areas_.asked.push_back({size * size, 1 / (size * size)});
        }
    }

private:
    /// Mark a point and its neighbours.
    void wake(std::size_t p, std::vector<char>& marks) const
    {
        marks[p] = 1;
        for (const Spoke& spoke : stars_[p]) {
            marks[static_cast<std::size_t>(spoke.next)] = 1;
            marks[static_cast<std::size_t>(spoke.across)] = 1;
        }
    }

    /// Pattern search: eight directions, the step halved where none wins.
    bool raise_at(std::size_t p)
    {
        constexpr double kDiagonal = 0.70710678118654752;
        static const std::array<Vec2, 8> kDirections{
            Vec2(1, 0),  Vec2(kDiagonal, kDiagonal),   Vec2(0, 1),  Vec2(-kDiagonal, kDiagonal),
            Vec2(-1, 0), Vec2(-kDiagonal, -kDiagonal), Vec2(0, -1), Vec2(kDiagonal, -kDiagonal)};
        const auto star = stars_[p];
        if (star.empty()) return false;
        double reach = kInfinity;
        for (const Spoke& spoke : star)
            reach = std::min(reach, (points_[static_cast<std::size_t>(spoke.next)] - points_[p]).norm());
        double least = least_sine(points_, star, points_[p]);
        const double before = least;
        for (double step = reach / 4; step > reach / 300; step /= 2) {
            for (bool better = true; better;) {
                better = false;
                const Vec2 from = points_[p];
                for (const Vec2& direction : kDirections) {
                    const Vec2 to = from + step * direction;
                    const double found = least_sine(points_, star, to);
                    if (found <= least + 1e-3 * step / reach) continue;
                    least = found;
                    points_[p] = to;
                    better = true;
                }
            }
        }
        return least > before + 1e-3;
    }

    std::vector<Vec2>& points_;
    std::span<const Quad> quads_;
    std::size_t fixed_;
    const SmoothPlaneOptions& options_;
    Stars stars_;
    std::vector<char> awake_;    ///< points to be swept
    std::vector<char> restless_; ///< points to be raised where quads are poor
    Areas areas_;
};

} // namespace

SmoothedPlane smooth_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed,
                           const SmoothPlaneOptions& options, const RunContext& context)
{
    SmoothedPlane result;
    Range range = range_of(points, quads);
    result.min_before = result.min_after = range.least;
    result.was_folded = result.folded = range.folded > 0;
    if (fixed >= points.size()) return result;
    if (result.was_folded && options.untangle) {
        std::vector<char> mask(points.size(), 0);
        std::fill(mask.begin(), mask.begin() + static_cast<std::ptrdiff_t>(fixed), 1);
        untangle_plane(points, quads, mask, {});
        range = range_of(points, quads);
    }
    Smoother smoother(points, quads, fixed, options);
    smoother.ask_sizes();
    for (int i = 0; i < options.sweeps; ++i) {
        check_cancelled(context);
        const double overstep = i == 0 || i + 1 == options.sweeps ? 1 : kOverstep;
        if (smoother.sweep(std::max(0.0, range.least), overstep) == 0) break;
    }
    for (int i = 0; i < options.repairs; ++i) {
        check_cancelled(context);
        if (!smoother.raise(options.good_enough)) break;
    }
    range = range_of(points, quads);
    result.min_after = range.least;
    result.folded = range.folded > 0;
    return result;
}

} // namespace lacuna::quads
