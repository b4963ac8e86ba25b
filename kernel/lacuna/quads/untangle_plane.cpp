// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/untangle_plane.h>

#include <lacuna/geometry/minimise.h>
#include <lacuna/quads/detail/corner_sine.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>

namespace lacuna::quads {

namespace {

/// Weight of the area term against the shape term, as Garanzha et al. have it.
constexpr double kAreaShare = 1.0 / 128;
/// Smallest regularisation. A choice, not a measurement.
constexpr double kLeastEpsilon = 1e-3;
/// Steps that L-BFGS remembers, and steps in a round with one ε. Choices, not measurements.
constexpr std::size_t kMemory = 8;
constexpr int kSteps = 100;
/// Rounds at most, and rounds without gain after which it is given up. Choices, not measurements.
constexpr int kRounds = 30, kIdleRounds = 3;
/// Least share of the value that a step must win, and of the least determinant a round. Choices too.
constexpr double kLeastGain = 1e-5, kLeastRise = 1e-4;
/// Rings of quads that move with the folded ones: at first, and where that was not enough. Choices too.
constexpr std::array<int, 2> kRings{3, 10};

/// A quad and the length its corners are measured against.
struct ReferenceQuad {
    Quad corners;
    double inverse; ///< 1 / reference length
};

/// The folded quads, the rings around them and the points inside.
struct FoldedPart {
    std::vector<ReferenceQuad> cells;
    std::vector<Index> moving;   ///< points
    std::vector<Index> variable; ///< of each point; -1: stays
};

/// Least determinant of the corners of a quad that can change; those of three fixed points are left out.
double least_movable(std::span<const Vec2> points, const Quad& quad, const std::vector<char>& fixed)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const auto here = static_cast<std::size_t>(quad[k]),
                   next = static_cast<std::size_t>(quad[(k + 1) % 4]),
                   before = static_cast<std::size_t>(quad[(k + 3) % 4]);
        if (fixed[here] != 0 && fixed[next] != 0 && fixed[before] != 0) continue;
        const Vec2 a = points[next] - points[here], b = points[before] - points[here];
        least = std::min(least, cross(a, b));
    }
    return least;
}

/// The quads that are folded and `rings` rings around them.
FoldedPart part_around_folds(std::span<const Vec2> points, std::span<const Quad> quads,
                             const std::vector<char>& fixed, const std::vector<double>& size, int rings)
{
    std::vector<char> touched(points.size(), 0), taken(quads.size(), 0);
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (least_movable(points, quads[q], fixed) > 0) continue;
        taken[q] = 1;
    }
    for (int ring = 0; ring < rings; ++ring) {
        for (std::size_t q = 0; q < quads.size(); ++q) {
            if (taken[q] == 0) continue;
            for (const Index p : quads[q]) touched[index(p)] = 1;
        }
        for (std::size_t q = 0; q < quads.size(); ++q) {
            for (const Index p : quads[q]) taken[q] |= touched[index(p)];
        }
    }
    std::vector<char> stays = fixed;
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
            const auto a = static_cast<std::size_t>(quads[q][k]);
            const auto b = static_cast<std::size_t>(quads[q][(k + 1) % 4]);
            length += (size.empty() ? (points[b] - points[a]).norm() : size[a]) / 4;
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

    double operator()(const Eigen::VectorXd& x, Eigen::VectorXd& gradient) const
    {
        gradient.setZero(x.size());
        double sum = 0;
        for (const ReferenceQuad& cell : part_.cells) {
            std::array<Vec2, 4> corner, slope;
            for (std::size_t k = 0; k < 4; ++k) corner[k] = place(x, cell.corners[k]);
            slope.fill(Vec2::Zero());
            for (std::size_t k = 0; k < 4; ++k) sum += corner_energy(corner, k, cell.inverse, slope);
            for (std::size_t k = 0; k < 4; ++k) {
                const Index v = part_.variable[static_cast<std::size_t>(cell.corners[k])];
                if (v >= 0) gradient.segment<2>(2 * v) += slope[k];
            }
        }
        return sum;
    }

    /// Least determinant over all corners that move, in units of the references.
    [[nodiscard]] double least_determinant(const Eigen::VectorXd& x) const
    {
        double least = std::numeric_limits<double>::infinity();
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

    double corner_energy(const std::array<Vec2, 4>& corner, std::size_t k, double inverse,
                         std::array<Vec2, 4>& slope) const
    {
        const std::size_t n = (k + 1) % 4, r = (k + 3) % 4;
        const Vec2 a = (corner[n] - corner[k]) * inverse, b = (corner[r] - corner[k]) * inverse;
        const double d = cross(a, b);
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
    const FoldedPart& part_;
};

} // namespace

bool untangle_plane(std::vector<Vec2>& points, std::span<const Quad> quads, const std::vector<char>& fixed,
                    const std::vector<double>& size)
{
    for (const int rings : kRings) {
        const FoldedPart part = part_around_folds(points, quads, fixed, size, rings);
        if (part.cells.empty()) return true;
        if (part.moving.empty()) continue;
        Eigen::VectorXd x(2 * static_cast<Eigen::Index>(part.moving.size()));
        for (std::size_t v = 0; v < part.moving.size(); ++v)
            x.segment<2>(2 * static_cast<Eigen::Index>(v)) = points[index(part.moving[v])];
        FoldEnergy energy(points, part);
        geometry::MinimiseOptions how;
        how.iterations = kSteps;
        how.least_gain = kLeastGain;
        how.memory = kMemory;
        how.start_anew = false;
        double last = energy.least_determinant(x);
        for (int round = 0, idle = 0; round < kRounds && last <= 0 && idle < kIdleRounds; ++round) {
            energy.epsilon = std::sqrt(kLeastEpsilon * kLeastEpsilon + 0.04 * last * last);
            geometry::minimise(std::cref(energy), x, how);
            const double now = energy.least_determinant(x);
            idle = now > last + kLeastRise * std::abs(last) ? 0 : idle + 1;
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
