// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/plane_stars.h>

#include <lacuna/geometry/minimise.h>
#include <lacuna/quads/measure_plane.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lacuna::quads {

namespace {

/// Weight of the area term against the shape term, as Garanzha et al.
constexpr double kAreaShare = 1.0 / 128;
/// Smallest regularisation.
constexpr double kLeastEpsilon = 1e-3;
constexpr std::size_t kMemory = 8;
constexpr int kSteps = 100;
constexpr int kRounds = 30;
/// Layers of quads around the folded ones that move with them: first, and when that did not do.
constexpr std::array<int, 2> kRings{3, 10};

struct Cell {
    Quad corners;
    double inverse; ///< 1 / reference length
};

struct Region {
    std::vector<Cell> cells;
    std::vector<Index> moving;   ///< points
    std::vector<Index> variable; ///< of each point; -1: stays
};

/// Least determinant of the corners of a quad that can be moved; folded ones that cannot be are not for us.
double least_movable(std::span<const Vec2> points, const Quad& quad, const std::vector<char>& fixed)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const auto here = static_cast<std::size_t>(quad[k]),
                   next = static_cast<std::size_t>(quad[(k + 1) % 4]),
                   before = static_cast<std::size_t>(quad[(k + 3) % 4]);
        if (fixed[here] != 0 && fixed[next] != 0 && fixed[before] != 0) continue;
        const Vec2 a = points[next] - points[here], b = points[before] - points[here];
        least = std::min(least, a.x() * b.y() - a.y() * b.x());
    }
    return least;
}

/// Quads that are folded, `rings` layers around them, and the points inside.
Region region_of(std::span<const Vec2> points, std::span<const Quad> quads, const std::vector<char>& fixed,
                 const std::vector<double>& size, int rings)
{
    std::vector<char> touched(points.size(), 0), taken(quads.size(), 0);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (least_movable(points, quads[q], fixed) > 0) continue;
        taken[q] = 1;
    }
    for (int ring = 0; ring < rings; ++ring) {
        for (std::size_t q = 0; q < quads.size(); ++q) {
            if (taken[q] == 0) continue;
            for (const Index p : quads[q]) touched[static_cast<std::size_t>(p)] = 1;
        }
        for (std::size_t q = 0; q < quads.size(); ++q) {
            for (const Index p : quads[q]) taken[q] |= touched[static_cast<std::size_t>(p)];
        }
    }
    std::vector<char> stays = fixed;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (taken[q] != 0) continue;
        for (const Index p : quads[q]) stays[static_cast<std::size_t>(p)] = 1;
    }
    Region region;
    region.variable.assign(points.size(), -1);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (taken[q] == 0) continue;
        double length = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto a = static_cast<std::size_t>(quads[q][k]);
            const auto b = static_cast<std::size_t>(quads[q][(k + 1) % 4]);
            length += (size.empty() ? (points[b] - points[a]).norm() : size[a]) / 4;
            if (stays[a] != 0 || region.variable[a] >= 0) continue;
            region.variable[a] = static_cast<Index>(region.moving.size());
            region.moving.push_back(quads[q][k]);
        }
        region.cells.push_back({quads[q], length > 0 ? 1 / length : 1});
    }
    return region;
}

class Energy {
public:
    Energy(std::span<const Vec2> points, const Region& region) : points_(points), region_(region) {}

    double epsilon = 1;

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const
    {
        gradient.setZero(x.size());
        double sum = 0;
        for (const Cell& cell : region_.cells) {
            std::array<Vec2, 4> corner, slope;
            for (std::size_t k = 0; k < 4; ++k) corner[k] = place(x, cell.corners[k]);
            slope.fill(Vec2::Zero());
            for (std::size_t k = 0; k < 4; ++k) sum += corner_energy(corner, k, cell.inverse, slope);
            for (std::size_t k = 0; k < 4; ++k) {
                const Index v = region_.variable[static_cast<std::size_t>(cell.corners[k])];
                if (v >= 0) gradient.segment<2>(2 * v) += slope[k];
            }
        }
        return sum;
    }

    /// Least determinant over all corners that move, in units of the references.
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x) const
    {
        double least = std::numeric_limits<double>::infinity();
        for (const Cell& cell : region_.cells) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (!moves(cell.corners[k]) && !moves(cell.corners[(k + 1) % 4]) &&
                    !moves(cell.corners[(k + 3) % 4]))
                    continue;
                const Vec2 here = place(x, cell.corners[k]);
                const Vec2 a = (place(x, cell.corners[(k + 1) % 4]) - here) * cell.inverse;
                const Vec2 b = (place(x, cell.corners[(k + 3) % 4]) - here) * cell.inverse;
                least = std::min(least, a.x() * b.y() - a.y() * b.x());
            }
        }
        return least;
    }

private:
    [[nodiscard]] bool moves(Index p) const { return region_.variable[static_cast<std::size_t>(p)] >= 0; }
    [[nodiscard]] Vec2 place(const Eigen::VectorXd& x, Index p) const
    {
        const Index v = region_.variable[static_cast<std::size_t>(p)];
        return v >= 0 ? Vec2(x.segment<2>(2 * v)) : points_[static_cast<std::size_t>(p)];
    }

    double corner_energy(const std::array<Vec2, 4>& corner, std::size_t k, double inverse,
                         std::array<Vec2, 4>& slope) const
    {
        const std::size_t n = (k + 1) % 4, r = (k + 3) % 4;
        const Vec2 a = (corner[n] - corner[k]) * inverse, b = (corner[r] - corner[k]) * inverse;
        const double d = a.x() * b.y() - a.y() * b.x();
        const double root = std::sqrt(epsilon * epsilon + d * d);
        const double chi = (d + root) / 2;
        const double chi_slope = (1 + d / root) / 2;
        const double shape = (a.squaredNorm() + b.squaredNorm()) / chi;
        const double area = (1 + d * d) / chi;
        const double by_d = (1 - kAreaShare) * -shape / chi * chi_slope +
                            kAreaShare * (2 * d / chi - area / chi * chi_slope);
        const double by_length = (1 - kAreaShare) * 2 / chi;
        const Vec2 by_a = inverse * (by_length * a + by_d * Vec2(b.y(), -b.x()));
        const Vec2 by_b = inverse * (by_length * b + by_d * Vec2(-a.y(), a.x()));
        slope[n] += by_a;
        slope[r] += by_b;
        slope[k] -= by_a + by_b;
        return (1 - kAreaShare) * shape + kAreaShare * area;
    }

    std::span<const Vec2> points_;
    const Region& region_;
};

} // namespace

bool untangle_plane(std::vector<Vec2>& points, std::span<const Quad> quads, const std::vector<char>& fixed,
                    const std::vector<double>& size)
{
    for (const int rings : kRings) {
        const Region region = region_of(points, quads, fixed, size, rings);
        if (region.cells.empty()) return true;
        if (region.moving.empty()) continue;
        Eigen::VectorXd x(2 * static_cast<Eigen::Index>(region.moving.size()));
        for (std::size_t v = 0; v < region.moving.size(); ++v)
            x.segment<2>(2 *
                         static_cast<Eigen::Index>(v)) = points[static_cast<std::size_t>(region.moving[v])];
        Energy energy(points, region);
        geometry::MinimiseOptions how;
        how.iterations = kSteps;
        how.least_gain = 1e-5;
        how.memory = kMemory;
        how.start_anew = false;
        double last = energy.least_determinant(x);
        for (int round = 0, idle = 0; round < kRounds && last <= 0 && idle < 3; ++round) {
            energy.epsilon = std::sqrt(kLeastEpsilon * kLeastEpsilon + 0.04 * last * last);
            geometry::minimise(std::cref(energy), x, how);
            const double now = energy.least_determinant(x);
            idle = now > last + 1e-4 * std::abs(last) ? 0 : idle + 1;
            last = now;
        }
        if (!(last > 0)) continue;
        for (std::size_t v = 0; v < region.moving.size(); ++v)
            points[static_cast<std::size_t>(region.moving[v])] = x.segment<2>(2 *
                                                                              static_cast<Eigen::Index>(v));
        return true;
    }
    return false;
}

} // namespace lacuna::quads
