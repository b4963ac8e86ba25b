// SPDX-License-Identifier: MIT
#include <lacuna/geometry/detail/flatten_maps.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/harmonic.h>
#include <lacuna/geometry/shared/plane.h>
#include <lacuna/geometry/shared/polyline.h>

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace lacuna::geometry::flat {

namespace {

using Complex = std::complex<double>;
using Eigen::Matrix2d;

/// √ε: triangles that are thinner, relative to their longest side, are degenerate.
const double kHalfDigits = std::sqrt(std::numeric_limits<double>::epsilon());

template <class Solver>
void check_solved(const Solver& solver)
{
    if (solver.info() != Eigen::Success)
        throw BackendError(Message("geometry.singular",
                                   "facets cannot be flattened: the equations of the map "
                                   "have no unique solution")
                               .remedy("check for facets that are connected at one point only, or for "
                                       "coordinates that are not numbers"));
}

double signed_area(const Vec2& a, const Vec2& b, const Vec2& c) { return 0.5 * cross(b - a, c - a); }

/// A triangle in its own plane, with its longest side along x. Width and height are limited from below,
/// against rounding.
std::array<Vec2, 3> own_plane(const std::array<Vec3, 3>& p, double extent, bool& thin)
{
    std::size_t base = 0;
    double longest = -1;
    for (std::size_t i = 0; i < 3; ++i) {
        const double side = (p[(i + 1) % 3] - p[i]).norm();
        if (side > longest) {
            longest = side;
            base = i;
        }
    }
    const std::size_t next = (base + 1) % 3, top = (base + 2) % 3;
    const double width = std::max(longest, kHalfDigits * extent);
    const Vec3 along = longest > 0 ? Vec3((p[next] - p[base]) / longest) : Vec3(Vec3::Zero());
    const Vec3 to_top = p[top] - p[base];
    const double height = to_top.cross(along).norm();
    thin = !(height > kHalfDigits * width);
    std::array<Vec2, 3> q;
    q[base] = Vec2(0, 0);
    q[next] = Vec2(width, 0);
    q[top] = Vec2(to_top.dot(along), std::max(height, kHalfDigits * width));
    return q;
}

} // namespace

std::vector<Vec3> closed_places(const Facets& facets, const std::vector<Index>& loop)
{
    std::vector<Vec3> places;
    for (const Index i : loop) places.push_back(facets.points[index(i)]);
    places.push_back(places.front());
    return places;
}

void measure_shapes(Facets& facets)
{
    Eigen::AlignedBox3d box;
    for (const Vec3& point : facets.points) box.extend(point);
    const double extent = box.diagonal().norm();
    facets.shapes.resize(facets.triangles.size());
    facets.area = 0;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        const Triangle& c = facets.triangles[t];
        const std::array<Vec3, 3> p{facets.points[index(c[0])], facets.points[index(c[1])],
                                    facets.points[index(c[2])]};
        Shape& shape = facets.shapes[t];
        const std::array<Vec2, 3> q = own_plane(p, extent, shape.thin);
        shape.area = signed_area(q[0], q[1], q[2]);
        for (std::size_t i = 0; i < 3; ++i) {
            // The side opposite the corner, rotated inwards.
            const Vec2 side = q[(i + 2) % 3] - q[(i + 1) % 3];
            shape.gradient[i] = Vec2(-side.y(), side.x()) / (2 * shape.area);
        }
        facets.area += 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
    }
}

Matrix2d jacobian(const Facets& facets, std::size_t triangle, const Positions& positions)
{
    const Triangle& c = facets.triangles[triangle];
    const Shape& shape = facets.shapes[triangle];
    const Vec2& first = positions[index(c[0])];
    return (positions[index(c[1])] - first) * shape.gradient[1].transpose() +
           (positions[index(c[2])] - first) * shape.gradient[2].transpose();
}

std::array<double, 2> stretches(const Matrix2d& j)
{
    const double rigid = 0.5 * std::hypot(j(0, 0) + j(1, 1), j(1, 0) - j(0, 1));
    const double mirrored = 0.5 * std::hypot(j(0, 0) - j(1, 1), j(1, 0) + j(0, 1));
    return {rigid + mirrored, rigid - mirrored};
}

void scale_to_area(const Facets& facets, Positions& positions)
{
    double area = 0;
    for (const Triangle& c : facets.triangles)
        area += signed_area(positions[index(c[0])], positions[index(c[1])], positions[index(c[2])]);
    if (!(area > 0)) return;
    const double scale = std::sqrt(facets.area / area);
    Vec2 mean = Vec2::Zero();
    for (const Vec2& p : positions) mean += p / static_cast<double>(positions.size());
    for (Vec2& p : positions) p = scale * (p - mean);
}

// --- conformal ------------------------------------------------------------------------------------

Positions conformal(const Facets& facets)
{
    // Two points of the outer boundary that are far apart are fixed; their distance is corrected by scaling.
    const std::vector<Index>& rim = facets.loops.front();
    const auto farthest = [&](const Vec3& from) {
        return *std::max_element(rim.begin(), rim.end(), [&](Index a, Index b) {
            return (facets.points[index(a)] - from).squaredNorm() <
                   (facets.points[index(b)] - from).squaredNorm();
        });
    };
    const Index first = farthest(facets.points[index(rim.front())]);
    const Index second = farthest(facets.points[index(first)]);
    const auto count = static_cast<Index>(facets.points.size());
    std::vector<Complex> value(facets.points.size());
    value[index(second)] = (facets.points[index(second)] - facets.points[index(first)]).norm();

    std::vector<Index> unknown(facets.points.size(), -1);
    Index size = 0;
    for (Index i = 0; i < count; ++i)
        if (i != first && i != second) unknown[index(i)] = size++;
    if (size == 0) return Positions(facets.points.size(), Vec2::Zero());

    // Let the positions u and the gradients g be complex numbers. The derivative of the map by the conjugate
    // variable is ½ Σ g_i u_i; it vanishes for rotations with scaling. The energy is the sum of its squares.
    std::vector<Eigen::Triplet<Complex>> entries;
    Eigen::VectorXcd right = Eigen::VectorXcd::Zero(size);
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        const Triangle& c = facets.triangles[t];
        const Shape& shape = facets.shapes[t];
        std::array<Complex, 3> g;
        for (std::size_t i = 0; i < 3; ++i) g[i] = {shape.gradient[i].x(), shape.gradient[i].y()};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) {
                const Index row = unknown[index(c[i])], column = unknown[index(c[j])];
                if (row < 0) continue;
                const Complex entry = shape.area * std::conj(g[i]) * g[j];
                if (column >= 0)
                    entries.emplace_back(row, column, entry);
                else
                    right[row] -= entry * value[index(c[j])];
            }
    }
    Eigen::SparseMatrix<Complex> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> solver(matrix);
    check_solved(solver);
    const Eigen::VectorXcd solution = solver.solve(right);
    Positions positions;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const Complex z = unknown[i] >= 0 ? solution[unknown[i]] : value[i];
        positions.emplace_back(z.real(), z.imag());
    }
    scale_to_area(facets, positions);
    return positions;
}

// --- as rigid as possible -------------------------------------------------------------------------

namespace {

/// The rotation closest to a matrix.
Matrix2d rotation_of(const Matrix2d& j)
{
    const double c = j(0, 0) + j(1, 1), s = j(1, 0) - j(0, 1), size = std::hypot(c, s);
    Matrix2d r = Matrix2d::Identity();
    if (size > 0) r << c / size, -s / size, s / size, c / size;
    return r;
}

} // namespace

Positions as_rigid_as_possible(const Facets& facets, Positions positions, double settled)
{
    // The stiffness matrix is constant: factor it once, with point 0 fixed.
    const auto size = static_cast<Index>(positions.size()) - 1;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        const Triangle& c = facets.triangles[t];
        const Shape& shape = facets.shapes[t];
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                if (c[i] > 0 && c[j] > 0)
                    entries.emplace_back(c[i] - 1, c[j] - 1,
                                         shape.area * shape.gradient[i].dot(shape.gradient[j]));
    }
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    check_solved(solver);

    Eigen::MatrixX2d right(size, 2);
    double before = kInfinity;
    for (int iteration = 0; iteration < kMostRounds; ++iteration) {
        double energy = 0;
        right.setZero();
        for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
            const Triangle& c = facets.triangles[t];
            const Shape& shape = facets.shapes[t];
            const Matrix2d j = jacobian(facets, t, positions), r = rotation_of(j);
            energy += shape.area * (j - r).squaredNorm();
            for (std::size_t i = 0; i < 3; ++i)
                if (c[i] > 0) right.row(c[i] - 1) += shape.area * (r * shape.gradient[i]).transpose();
        }
        if (!(before - energy > settled * before) && iteration > 0) break;
        before = energy;
        const Eigen::MatrixX2d solution = solver.solve(right);
        positions[0].setZero();
        for (Index i = 0; i < size; ++i) positions[index(i + 1)] = solution.row(i).transpose();
    }
    scale_to_area(facets, positions);
    return positions;
}

// --- injective ------------------------------------------------------------------------------------

namespace {

/// Symmetric Dirichlet energy; infinite if a triangle is degenerate or flipped.
double symmetric_dirichlet(const Facets& facets, const Positions& positions)
{
    double energy = 0;
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        const auto [large, small] = stretches(jacobian(facets, t, positions));
        if (!(small > 0)) return kInfinity;
        energy += facets.shapes[t].area *
                  (large * large + small * small + 1 / (large * large) + 1 / (small * small));
    }
    return energy;
}

/// The step length at which the first triangle degenerates, at most `limit`.
double step_to_flip(const Facets& facets, const Positions& from, const Positions& step, double limit)
{
    for (const Triangle& c : facets.triangles) {
        const Vec2 a = from[index(c[1])] - from[index(c[0])], b = from[index(c[2])] - from[index(c[0])];
        const Vec2 da = step[index(c[1])] - step[index(c[0])], db = step[index(c[2])] - step[index(c[0])];
        // Area along the step: k0 + k1 s + k2 s², with k0 > 0. The smallest positive root is computed without
        // cancellation.
        const double k0 = cross(a, b), k1 = cross(a, db) + cross(da, b), k2 = cross(da, db);
        const double inside = k1 * k1 - 4 * k2 * k0;
        if (inside < 0) continue;
        const double q = -0.5 * (k1 + (k1 < 0 ? -1 : 1) * std::sqrt(inside));
        for (const double root : {q != 0 ? k0 / q : -1.0, k2 != 0 ? q / k2 : -1.0})
            if (root > 0) limit = std::min(limit, root);
    }
    return limit;
}

/// Quadratic approximation of the symmetric Dirichlet energy near some positions: Σ area |W (J − R)|² over
/// the triangles. J is the gradient of the map, R the rotation closest to J. The weights W are such that the
/// approximation has the gradient of the energy at these positions (Rabinovich et al. 2017).
class Proxy {
public:
    explicit Proxy(const Facets& facets) : facets_(facets), size_(2 * (Index(facets.points.size()) - 1)) {}

    /// The minimum of the approximation at `positions`, with point 0 fixed.
    Positions minimiser(const Positions& positions)
    {
        entries_.clear();
        Eigen::VectorXd right = Eigen::VectorXd::Zero(size_);
        for (std::size_t t = 0; t < facets_.triangles.size(); ++t) add(t, positions, right);
        Eigen::SparseMatrix<double> matrix(size_, size_);
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        if (!analysed_) solver_.analyzePattern(matrix);
        analysed_ = true;
        solver_.factorize(matrix);
        if (solver_.info() != Eigen::Success) return positions;
        const Eigen::VectorXd solution = solver_.solve(right);
        Positions result = positions;
        for (Index i = 0; i < size_ / 2; ++i)
            result[index(i + 1)] = positions[0] + Vec2(solution[2 * i], solution[2 * i + 1]);
        return result;
    }

private:
    void add(std::size_t t, const Positions& positions, Eigen::VectorXd& right)
    {
        const Triangle& c = facets_.triangles[t];
        const Shape& shape = facets_.shapes[t];
        const Matrix2d j = jacobian(facets_, t, positions), r = rotation_of(j);
        // J = (J Rᵀ) R, where J Rᵀ is symmetric and positive; the weights are defined in its principal axes.
        const auto [large, small] = stretches(j);
        const auto weight = [](double s) { return 2 * (s + 1) * (s * s + 1) / (s * s * s); };
        const Matrix2d stretch = j * r.transpose();
        Matrix2d squared = weight(large) * Matrix2d::Identity();
        if (large - small > kHalfDigits * large) {
            const double slope = (weight(large) - weight(small)) / (large - small);
            squared += slope * (0.5 * (stretch + stretch.transpose()) - large * Matrix2d::Identity());
        }
        for (std::size_t i = 0; i < 3; ++i) {
            if (c[i] == 0) continue;
            right.segment<2>(2 * (c[i] - 1)) += shape.area * (squared * (r * shape.gradient[i]));
            for (std::size_t k = 0; k < 3; ++k) {
                if (c[k] == 0) continue;
                const Matrix2d block = shape.area * shape.gradient[i].dot(shape.gradient[k]) * squared;
                for (int x = 0; x < 2; ++x)
                    for (int y = 0; y < 2; ++y)
                        entries_.emplace_back(2 * (c[i] - 1) + x, 2 * (c[k] - 1) + y, block(x, y));
            }
        }
    }

    const Facets& facets_;
    Index size_;
    bool analysed_ = false;
    std::vector<Eigen::Triplet<double>> entries_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver_;
};

} // namespace

Positions injective(const Facets& facets, Positions positions, double settled)
{
    scale_to_area(facets, positions);
    double energy = symmetric_dirichlet(facets, positions);
    if (!std::isfinite(energy)) return positions;
    Proxy proxy(facets);
    for (int iteration = 0; iteration < kMostRounds; ++iteration) {
        Positions step = proxy.minimiser(positions);
        for (std::size_t i = 0; i < step.size(); ++i) step[i] -= positions[i];
        // Start at 80 % of the step to the first flip, and halve until the energy decreases.
        double length = std::min(1.0, 0.8 * step_to_flip(facets, positions, step, 2.0));
        Positions trial(positions.size());
        double found = energy;
        for (; length > std::numeric_limits<double>::epsilon(); length *= 0.5) {
            for (std::size_t i = 0; i < step.size(); ++i) trial[i] = positions[i] + length * step[i];
            found = symmetric_dirichlet(facets, trial);
            if (found < energy) break;
        }
        if (!(found < energy)) break;
        const bool done = energy - found <= settled * energy;
        positions = trial;
        energy = found;
        if (done) break;
    }
    scale_to_area(facets, positions);
    return positions;
}

// --- convex ---------------------------------------------------------------------------------------

Positions convex(const Facets& facets)
{
    // Close each hole by triangles around an additional point, so that the facets form a disc.
    std::vector<Vec3> points = facets.points;
    std::vector<Triangle> triangles = facets.triangles;
    for (std::size_t hole = 1; hole < facets.loops.size(); ++hole) {
        const std::vector<Index>& loop = facets.loops[hole];
        Vec3 mean = Vec3::Zero();
        for (const Index i : loop) mean += points[index(i)] / static_cast<double>(loop.size());
        const auto hub = static_cast<Index>(points.size());
        points.push_back(mean);
        for (std::size_t i = 0; i < loop.size(); ++i)
            triangles.push_back({loop[(i + 1) % loop.size()], loop[i], hub});
    }
    HarmonicProblem problem;
    problem.points = points;
    problem.triangles = triangles;
    problem.fixed = facets.loops.front();
    const std::vector<double> lengths = arc_lengths(closed_places(facets, problem.fixed));
    const double radius = std::sqrt(facets.area / std::numbers::pi);
    problem.fixed_values.resize(static_cast<Eigen::Index>(problem.fixed.size()), 2);
    for (std::size_t i = 0; i < problem.fixed.size(); ++i) {
        const double angle = 2 * std::numbers::pi * lengths[i] / lengths.back();
        problem.fixed_values.row(static_cast<Eigen::Index>(i)) << radius * std::cos(angle),
            radius * std::sin(angle);
    }
    const Eigen::MatrixXd values = solve_harmonic(problem);
    Positions positions(facets.points.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        positions[i] = values.row(static_cast<Eigen::Index>(i)).transpose();
    scale_to_area(facets, positions);
    return positions;
}

} // namespace lacuna::geometry::flat
