// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/untangle_plane.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/foldover.h>
#include <lacuna/geometry/shared/minimise.h>
#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/detail/plane_energy.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lacuna::quads {

namespace {

using geometry::kSizeShare;

/// Number of rings of quads around the folded quads that move with them: in the first attempt and, if it
/// fails, in the second.
constexpr std::array<int, 2> kRings{3, 10};

/// A quad, and its reference length: determinants of its corners are divided by the square of this length.
struct ReferenceQuad {
    Quad corners;
    double inverse; ///< 1 / reference length
};

/// The folded quads with the rings around them, and the points that may move.
struct FoldedPart {
    std::vector<ReferenceQuad> cells;
    std::vector<Index> moving;   ///< points that move
    std::vector<Index> variable; ///< for each point, its index in `moving`; -1: it does not move
};

/// Smallest determinant of those corners of a quad that can change. A corner of three fixed points cannot.
double least_movable(std::span<const Vec2> points, const Quad& quad, std::size_t fixed)
{
    double least = kInfinity;
    for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t here = index(quad[k]), next = index(quad[(k + 1) % 4]),
                          before = index(quad[(k + 3) % 4]);
        if (std::max({here, next, before}) < fixed) continue;
        const Vec2 a = points[next] - points[here], b = points[before] - points[here];
        least = std::min(least, cross(a, b));
    }
    return least;
}

/// The folded quads, and `rings` rings of quads around them.
FoldedPart part_around_folds(std::span<const Vec2> points, std::span<const Quad> quads, std::size_t fixed,
                             int rings)
{
    std::vector<char> touched(points.size(), 0), taken(quads.size(), 0);
    for (std::size_t q = 0; q < quads.size(); ++q) taken[q] = !(least_movable(points, quads[q], fixed) > 0);
    for (int ring = 0; ring < rings; ++ring) {
        for (std::size_t q = 0; q < quads.size(); ++q) {
            if (taken[q] == 0) continue;
            for (const Index p : quads[q]) touched[index(p)] = 1;
        }
        for (std::size_t q = 0; q < quads.size(); ++q) {
            for (const Index p : quads[q]) taken[q] |= touched[index(p)];
        }
    }
    std::vector<char> stays(points.size(), 0);
    std::fill(stays.begin(), stays.begin() + static_cast<std::ptrdiff_t>(fixed), 1);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (taken[q] != 0) continue;
        for (const Index p : quads[q]) stays[index(p)] = 1;
    }
    FoldedPart part;
    part.variable.assign(points.size(), -1);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (taken[q] == 0) continue;
        double length = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto a = index(quads[q][k]);
            const auto b = index(quads[q][(k + 1) % 4]);
            length += (points[b] - points[a]).norm() / 4;
            if (stays[a] != 0 || part.variable[a] >= 0) continue;
            part.variable[a] = static_cast<Index>(part.moving.size());
            part.moving.push_back(quads[q][k]);
        }
        part.cells.push_back({quads[q], length > 0 ? 1 / length : 1});
    }
    return part;
}

/// The energy of Garanzha et al., a barrier regularised by `epsilon`.
class FoldEnergy {
public:
    FoldEnergy(std::span<const Vec2> points, const FoldedPart& part) : points_(points), part_(part) {}

    double epsilon = 1;

    /// The energy and its gradient. Compiled for the widest vectors of the machine; the results are
    /// bit-identical on all machines.
    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const
    {
        return with_avx2([&]() LACUNA_INLINE_BODY { return sum_up(x, gradient); });
    }

    /// Smallest determinant over all corners that can change, relative to the squared reference lengths.
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x) const
    {
        double least = kInfinity;
        for (const ReferenceQuad& cell : part_.cells) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (!moves(cell.corners[k]) && !moves(cell.corners[(k + 1) % 4]) &&
                    !moves(cell.corners[(k + 3) % 4]))
                    continue;
                const Vec2 here = place(x, cell.corners[k]);
                const Vec2 a = (place(x, cell.corners[(k + 1) % 4]) - here) * cell.inverse;
                const Vec2 b = (place(x, cell.corners[(k + 3) % 4]) - here) * cell.inverse;
                least = std::min(least, cross(a, b));
            }
        }
        return least;
    }

private:
    [[nodiscard]] bool moves(Index p) const { return part_.variable[index(p)] >= 0; }
    [[nodiscard]] Vec2 place(const Eigen::VectorXd& x, Index p) const
    {
        const Index v = part_.variable[index(p)];
        return v >= 0 ? Vec2(x.segment<2>(2 * v)) : points_[index(p)];
    }

    /// The four corners of a cell are evaluated together, one per vector lane.
    LACUNA_INLINE double sum_up(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const
    {
        gradient.setZero(x.size());
        const double least = epsilon * epsilon;
        double sum = 0;
        for (const ReferenceQuad& cell : part_.cells) {
            std::array<Index, 4> at;
            std::array<double, 4> px, py;
            for (std::size_t k = 0; k < 4; ++k) {
                at[k] = part_.variable[index(cell.corners[k])];
                const double* from = at[k] >= 0 ? x.data() + 2 * at[k]
                                                : points_[index(cell.corners[k])].data();
                px[k] = from[0] * cell.inverse;
                py[k] = from[1] * cell.inverse;
            }
            const Lanes here_x{px[0], px[1], px[2], px[3]}, here_y{py[0], py[1], py[2], py[3]};
            const Lanes ax = Lanes{px[1], px[2], px[3], px[0]} - here_x,
                        ay = Lanes{py[1], py[2], py[3], py[0]} - here_y,
                        bx = Lanes{px[3], px[0], px[1], px[2]} - here_x,
                        by = Lanes{py[3], py[0], py[1], py[2]} - here_y;
            const Lanes d = ax * by - ay * bx, squared = least + d * d;
            const Lanes root{std::sqrt(squared[0]), std::sqrt(squared[1]), std::sqrt(squared[2]),
                             std::sqrt(squared[3])};
            // The barrier χ, and its relative slope: χ' = χ / root.
            const Lanes over = 2 / (d + root), steep = 1 / root;
            const Lanes shape = (ax * ax + ay * ay + bx * bx + by * by) * over, area = (1 + d * d) * over;
            sum += sum_of((1 - kSizeShare) * shape + kSizeShare * area);
            const Lanes by_d = kSizeShare * (2 * d * over - area * steep) - (1 - kSizeShare) * shape * steep;
            const Lanes by_length = (1 - kSizeShare) * 2 * over;
            const Lanes gax = cell.inverse * (by_length * ax + by_d * by),
                        gay = cell.inverse * (by_length * ay - by_d * bx),
                        gbx = cell.inverse * (by_length * bx - by_d * ay),
                        gby = cell.inverse * (by_length * by + by_d * ax);
            const Lanes own_x = gax + gbx, own_y = gay + gby;
            for (std::size_t k = 0; k < 4; ++k) {
                if (at[k] < 0) continue;
                const std::size_t next = (k + 1) % 4, before = (k + 3) % 4;
                gradient[2 * at[k]] += gax[before] + gbx[next] - own_x[k];
                gradient[2 * at[k] + 1] += gay[before] + gby[next] - own_y[k];
            }
        }
        return sum;
    }

    std::span<const Vec2> points_;
    const FoldedPart& part_;
};

} // namespace

bool untangle_plane(std::vector<Vec2>& points, std::span<const Quad> quads, std::size_t fixed)
{
    for (const int rings : kRings) {
        const FoldedPart part = part_around_folds(points, quads, fixed, rings);
        if (part.cells.empty()) return true;
        if (part.moving.empty()) continue;
        Eigen::VectorXd x(2 * static_cast<Eigen::Index>(part.moving.size()));
        for (std::size_t v = 0; v < part.moving.size(); ++v)
            x.segment<2>(2 * static_cast<Eigen::Index>(v)) = points[index(part.moving[v])];
        FoldEnergy energy(points, part);
        geometry::MinimiseOptions how;
        how.start_anew = false;
        double last = energy.least_determinant(x);
        for (int round = 0, idle = 0; round < kMostRounds && last <= 0 && idle < kIdleRounds; ++round) {
            energy.epsilon = geometry::epsilon_for(last);
            x = geometry::minimise(std::cref(energy), std::move(x), how);
            const double now = energy.least_determinant(x);
            idle = now > last + kVisible * std::abs(last) ? 0 : idle + 1;
            last = now;
        }
        if (!(last > 0)) continue;
        for (std::size_t v = 0; v < part.moving.size(); ++v)
            points[index(part.moving[v])] = x.segment<2>(2 * static_cast<Eigen::Index>(v));
        return true;
    }
    return false;
}

} // namespace lacuna::quads
