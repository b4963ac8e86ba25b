// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/smooth_plane.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/shared/pattern_search.h>
#include <lacuna/quads/detail/plane_energy.h>
#include <lacuna/quads/detail/untangle_plane.h>
#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pattern_counts.h>

#include <algorithm>
#include <numeric>

namespace lacuna::quads {

namespace {

/// If a point moves by less than this share of the sides around it, its neighbours are not moved again. With
/// a higher value, smoothing ends earlier and meshes are less smooth.
constexpr double kStill = 0.02;
/// Over-relaxation: factor on the steps, except in the first and the last sweep. Compared with a factor of 1,
/// a tenth of the sweeps is enough to remove errors that span many quads. Measured: with 1.5 and 1.7 more
/// sweeps are needed, and 1.9 overshoots between poor quads.
constexpr double kOverstep = 1.85;

/// Whether some side is far shorter than every side between two fixed points. Both ends of such a side nearly
/// coincide, although the sines may be good.
bool has_needles(std::span<const Vec2> points, std::span<const Quad> quads, std::size_t fixed)
{
    // A side that is shorter than this share of the shortest fixed side is a needle.
    constexpr double kOfShortest = 0.05;
    double given = kInfinity, shortest = kInfinity;
    for (const Quad& quad : quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t a = index(quad[k]), b = index(quad[(k + 1) % 4]);
            double& least = a < fixed && b < fixed ? given : shortest;
            least = std::min(least, (points[a] - points[b]).squaredNorm());
        }
    }
    return given < kInfinity && shortest < kOfShortest * kOfShortest * given;
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
        std::fill(awake_.begin() + static_cast<std::ptrdiff_t>(fixed), awake_.end(), 1);
        if (points.size() >= kManyQuads) part_in_blocks();
    }

    /// Move every point that is awake by one step. In large meshes, the points inside blocks move first, with
    /// all blocks in parallel. The points between blocks move afterwards. The result is therefore the same
    /// for any number of threads.
    /// @return number of points that moved by more than `kStill`.
    std::size_t sweep(double floor, double overstep, const RunContext& context)
    {
        if (inside_.empty()) return sweep_range({fixed_, points_.size(), 0, floor, overstep});
        std::vector<std::size_t> moved((points_.size() - fixed_ + kBetweenPolls - 1) / kBetweenPolls, 0);
        parallel_each(context, moved.size(), 1, [&](std::size_t b) {
            const std::size_t first = fixed_ + b * kBetweenPolls;
            moved[b] = sweep_range(
                {first, std::min(first + kBetweenPolls, points_.size()), 1, floor, overstep});
        });
        return std::accumulate(moved.begin(), moved.end(),
                               sweep_range({fixed_, points_.size(), 0, floor, overstep}));
    }

    /// Move the points of poor quads to the positions at which the smallest sine around them is largest. From
    /// the second call on, only points near a point that has moved are tried. @return whether any point moved
    bool raise(double floor, const RunContext& context)
    {
        if (restless_.empty()) {
            restless_.assign(points_.size(), 1);
            least_side_ = sides_to_keep(points_, stars_, fixed_);
        }
        std::vector<char> is_poor(quads_.size(), 0), poor(points_.size(), 0);
        parallel_each(context, quads_.size(), kBetweenPolls, [&](std::size_t q) {
            const Quad& quad = quads_[q];
            const bool still = std::ranges::none_of(quad, [&](Index p) { return restless_[index(p)] != 0; });
            is_poor[q] = !still && scaled_jacobian(points_, quad) < floor;
        });
        for (std::size_t q = 0; q < quads_.size(); ++q) {
            if (is_poor[q] == 0) continue;
            for (const Index p : quads_[q]) poor[index(p)] = 1;
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

    void ask_sizes(const RunContext& context)
    {
        if (!options_.size || !(options_.size_weight > 0)) return;
        areas_.weight = options_.size_weight;
        areas_.asked.resize(points_.size());
        parallel_each(context, points_.size(), kBetweenPolls, [&](std::size_t p) {
            const double size = options_.size(points_[p]);
            areas_.asked[p] = {size * size, 1 / (size * size)};
        });
    }

private:
    /// The points that one task sweeps: those of an interval of numbers that pass a filter.
    struct Range {
        std::size_t first, last;
        char inside; ///< 1: points inside a block; 0: the others, or all points if there are no blocks
        double floor, overstep;
    };

    /// Find the points whose neighbours are all fixed or in the same block.
    void part_in_blocks()
    {
        inside_.assign(points_.size(), 0);
        for (std::size_t p = fixed_; p < points_.size(); ++p) {
            const std::size_t block = (p - fixed_) / kBetweenPolls;
            const auto is_near = [&](Index other) {
                return index(other) < fixed_ || (index(other) - fixed_) / kBetweenPolls == block;
            };
            const auto star = stars_[p];
            inside_[p] = std::ranges::all_of(star, [&](const Spoke& spoke) {
                return is_near(spoke.next) && is_near(spoke.across) && is_near(spoke.before);
            });
        }
    }

    /// As `sweep_points()`, compiled for the widest vectors of the machine. The results are bit-identical on
    /// all machines.
    std::size_t sweep_range(const Range& range)
    {
        return with_avx2([&]() LACUNA_INLINE_BODY { return sweep_points(range); });
    }

    LACUNA_INLINE std::size_t sweep_points(const Range& range)
    {
        const double floor = range.floor, overstep = range.overstep;
        std::size_t moved = 0;
        StarLanes lanes; // the star of the current point
        StarEnergy here;
        for (std::size_t p = range.first; p < range.last; ++p) {
            if (awake_[p] == 0 || (!inside_.empty() && inside_[p] != range.inside)) continue;
            awake_[p] = 0;
            const auto star = stars_[p];
            if (star.empty()) continue;
            lanes.set(points_, star, p, areas_);
            if (!lanes.differentiate(points_[p], areas_.weight, here)) continue;
            const double det = here.xx * here.yy - here.xy * here.xy;
            if (!(det > 0)) continue;
            const Vec2 step(-(here.yy * here.slope.x() - here.xy * here.slope.y()) / det,
                            -(here.xx * here.slope.y() - here.xy * here.slope.x()) / det);
            const double side = here.sides / static_cast<double>(2 * star.size());
            double length = overstep;
            for (int idle = 0; idle < kIdleRounds; ++idle, length = (length > 1 ? 1 : length / 2)) {
                const Vec2 to = points_[p] + length * step;
                const double least = floor * floor;
                double energy = lanes.energy(to, areas_.weight, least);
                // If the worst sine is already below the floor, it may stay there but must not decrease
                // further.
                if (energy > here.value && least > 0) {
                    const double sine = least_sine(points_, star, points_[p]);
                    if (sine < floor) energy = lanes.energy(to, areas_.weight, sine * sine);
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

    /// Mark a point and those of its neighbours that are not fixed.
    void wake(std::size_t p, std::vector<char>& marks) const
    {
        marks[p] = 1;
        for (const Spoke& spoke : stars_[p]) {
            for (const Index other : {spoke.next, spoke.across})
                if (index(other) >= fixed_) marks[index(other)] = 1;
        }
    }

    /// Move a point to the position where the smallest sine around it is largest. @return  whether this sine
    /// increased
    bool raise_at(std::size_t p)
    {
        const auto star = stars_[p];
        if (star.empty()) return false;
        // The sine alone would let points collapse onto each other. Sides therefore keep a share of their
        // mean length, or their present length if it is shorter.
        const double reach = shortest_side(points_, star, points_[p]);
        double sum = 0;
        for (const Spoke& spoke : star) sum += (points_[index(spoke.next)] - points_[p]).norm();
        const double shortest = std::max(
            least_side_[p], std::min(reach, kShortestKept * sum / static_cast<double>(star.size())));
        const double before = least_sine(points_, star, points_[p]);
        std::size_t first = 0;
        const auto sine_at = [&](const Vec2& to, double floor) {
            const double sine = least_sine_above(points_, star, to, floor, first);
            return sine > floor && shortest_side(points_, star, to) < shortest ? floor : sine;
        };
        return geometry::pattern_search(points_[p], before, {reach, kVisible}, sine_at) > before + kVisible;
    }

    std::vector<Vec2>& points_;
    std::span<const Quad> quads_;
    std::size_t fixed_;
    const SmoothPlaneOptions& options_;
    Stars stars_;
    std::vector<char> awake_;    ///< points to sweep
    std::vector<char> restless_; ///< points to raise if quads around them are poor
    /// For each point, whether it is inside its block; empty if there are no blocks.
    std::vector<char> inside_;
    std::vector<double> least_side_; ///< for each point, the shortest side that raising must keep [length]
    TargetAreas areas_;
};

} // namespace

void smooth_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed,
                  const SmoothPlaneOptions& options, const RunContext& context)
{
    if (fixed >= points.size()) return;
    double least = least_scaled_jacobian(points, quads, context);
    if (!(least > 0) && options.untangle) {
        untangle_plane(points, quads, fixed);
        least = least_scaled_jacobian(points, quads, context);
    }
    Smoother smoother(points, quads, fixed, options);
    smoother.ask_sizes(context);
    // Points that nearly coincide can separate only if sines may decrease in the meantime.
    const double floor = has_needles(points, quads, fixed) ? 0 : std::max(0.0, least);
    for (int i = 0; i < options.sweeps; ++i) {
        check_cancelled(context);
        const double overstep = i == 0 || i + 1 == options.sweeps ? 1 : kOverstep;
        if (smoother.sweep(floor, overstep, context) == 0) break;
    }
    for (int i = 0; i < options.repairs; ++i) {
        check_cancelled(context);
        if (!smoother.raise(options.good_enough, context)) break;
    }
}

} // namespace lacuna::quads
