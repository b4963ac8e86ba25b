// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/harmonic.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/detail/multigrid.h>
#include <lacuna/geometry/shared/affine.h>
#include <lacuna/geometry/shared/union_find.h>

#include <Eigen/SparseCore>
#include <Eigen/SparseLU>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

namespace lacuna::geometry {

namespace {

/// √ε: the lower limit of a weight, relative to the other weights of its point. Smaller weights would be lost
/// to rounding. The limit keeps the system regular and all weights positive.
const double kHalfDigits = std::sqrt(std::numeric_limits<double>::epsilon());

constexpr Index kFree = -1;

/// tan(angle / 2) between two sides, limited from below and above.
/// @param product  product of the lengths of the sides
double half_tangent(const Vec3& a, const Vec3& b, double product)
{
    const double cosine = a.dot(b), sine = a.cross(b).norm();
    // Two equivalent formulas, each without cancellation in its range.
    const double numerator = cosine > 0 ? sine : product - cosine;
    const double denominator = cosine > 0 ? product + cosine : sine;
    if (!(product > 0)) return 1;
    if (numerator >= denominator / kHalfDigits) return 1 / kHalfDigits;
    return std::max(numerator / denominator, kHalfDigits);
}

/// cot(angle) between two sides, limited.
double cotangent(const Vec3& a, const Vec3& b)
{
    const double product = a.norm() * b.norm();
    if (!(product > 0)) return 1;
    return a.dot(b) / std::max(a.cross(b).norm(), kHalfDigits * product);
}

/// Weight of a neighbour in the mean of a point.
struct Weight {
    Index from, to;
    int turns; ///< branch of the neighbour relative to the point
    double value;
};

/// Whether each point is on a border: there, some neighbour occurs in only one of its triangles.
std::vector<bool> on_border(const HarmonicProblem& problem)
{
    std::vector<std::uint32_t> met(problem.points.size(), 0); // exclusive or: neighbours that occur twice
                                                              // cancel
    for (const Triangle& t : problem.triangles) {
        for (std::size_t i = 0; i < 3; ++i)
            met[index(t[i])] ^= static_cast<std::uint32_t>(t[(i + 1) % 3]) ^
                                static_cast<std::uint32_t>(t[(i + 2) % 3]);
    }
    std::vector<bool> border;
    border.reserve(met.size());
    for (const std::uint32_t left : met) border.push_back(left != 0);
    return border;
}

/// The weights of all corners of all triangles, unordered: cotangents at points on a border, mean value
/// weights elsewhere. At a border point all neighbours are on one side, so mean value weights would depend on
/// the directions of the facets' diagonals. With cotangents there is no flux across the border.
std::vector<Weight> corner_weights(const HarmonicProblem& problem, const std::vector<bool>& border)
{
    std::vector<Weight> weights;
    weights.reserve(6 * problem.triangles.size());
    for (std::size_t t = 0; t < problem.triangles.size(); ++t) {
        const Triangle& triangle = problem.triangles[t];
        const std::array<int, 3> turns = problem.corner_turns.empty() ? std::array<int, 3>{}
                                                                      : problem.corner_turns[t];
        std::array<double, 3> side{}; // side i is opposite corner i
        std::array<Vec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = problem.points[index(triangle[i])];
        for (std::size_t i = 0; i < 3; ++i) side[i] = (p[(i + 1) % 3] - p[(i + 2) % 3]).norm();
        const double longest = std::max({side[0], side[1], side[2]});
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            if (problem.least_energy || border[index(triangle[i])]) {
                weights.push_back(
                    {triangle[i], triangle[j], turns[j] - turns[i], cotangent(p[i] - p[k], p[j] - p[k])});
                weights.push_back(
                    {triangle[i], triangle[k], turns[k] - turns[i], cotangent(p[i] - p[j], p[k] - p[j])});
                continue;
            }
            const double tangent = half_tangent(p[j] - p[i], p[k] - p[i], side[k] * side[j]);
            // Coincident points get equal weights.
            const auto add = [&](std::size_t to, double distance) {
                const double length = longest > 0 ? std::max(distance, kHalfDigits * longest) : 1;
                weights.push_back({triangle[i], triangle[to], turns[to] - turns[i], tangent / length});
            };
            add(j, side[k]);
            add(k, side[j]);
        }
    }
    return weights;
}

void check(const HarmonicProblem& problem)
{
    const auto fail = []<class... Arguments>(Format<sizeof...(Arguments)> format,
                                             const Arguments&... arguments) {
        throw InvalidInput(Message("geometry.harmonic_input", format, arguments...)
                               .about("harmonic values cannot be solved for"));
    };
    const auto count = static_cast<Index>(problem.points.size());
    for (const Triangle& triangle : problem.triangles)
        for (const Index corner : triangle)
            if (corner < 0 || corner >= count)
                fail("a triangle uses point {}, but there are {} points", found(corner), count);
    for (const Index point : problem.fixed)
        if (point < 0 || point >= count)
            fail("point {} is fixed, but there are {} points", found(point), count);
    if (problem.fixed_values.rows() != static_cast<Eigen::Index>(problem.fixed.size()))
        fail("{} points are fixed, but {} have values", needed(problem.fixed.size()),
             found(problem.fixed_values.rows()));
    if (problem.corner_turns.empty()) return;
    if (problem.corner_turns.size() != problem.triangles.size())
        fail("expected turns for {} triangles, found {}", needed(problem.triangles.size()),
             found(problem.corner_turns.size()));
    if (problem.period.size() != problem.fixed_values.cols())
        fail("the period has {} numbers, but each value has {}", found(problem.period.size()),
             needed(problem.fixed_values.cols()));
}

/// The role of each point: kFree or, for a fixed point, its row of fixed_values.
std::vector<Index> roles(const HarmonicProblem& problem)
{
    std::vector<Index> role(problem.points.size(), kFree);
    for (std::size_t i = 0; i < problem.fixed.size(); ++i)
        role[index(problem.fixed[i])] = static_cast<Index>(i);
    return role;
}

/// @param names  the caller's numbers of the points
/// @throw BackendError  a connected part has no fixed point.
void check_anchored(const HarmonicProblem& problem, std::span<const Index> role, std::span<const Index> names)
{
    UnionFind parts(problem.points.size());
    for (const Triangle& triangle : problem.triangles) {
        parts.unite(triangle[0], triangle[1]);
        parts.unite(triangle[0], triangle[2]);
    }
    std::vector<bool> anchored(problem.points.size(), false);
    for (const Index point : problem.fixed) anchored[parts.find(point)] = true;
    for (std::size_t i = 0; i < role.size(); ++i)
        if (role[i] == kFree && !anchored[parts.find(i)])
            throw BackendError(Message("geometry.singular",
                                       "harmonic values are not determined: the facets connected to point {} "
                                       "contain no point with a known value",
                                       names[i])
                                   .remedy("fix at least one point of each connected part"));
}

/// Group the weights by point, keeping their order.
std::vector<Weight> by_point(const std::vector<Weight>& weights, std::size_t points)
{
    std::vector<std::size_t> next(points + 1, 0);
    for (const Weight& w : weights) ++next[index(w.from) + 1];
    for (std::size_t p = 0; p < points; ++p) next[p + 1] += next[p];
    std::vector<Weight> sorted(weights.size());
    for (const Weight& w : weights) sorted[next[index(w.from)]++] = w;
    return sorted;
}

/// Normalise the weights of each point, which are grouped, to the sum 1.
/// @param positive  limit weights from below, so that rounding does not lose them
/// @return  for each point, the sum of its weights before normalising
std::vector<double> normalise(std::vector<Weight>& weights, std::size_t points, bool positive)
{
    std::vector<double> sums(points, 1);
    for (auto begin = weights.begin(); begin != weights.end();) {
        const auto end = std::find_if(begin, weights.end(),
                                      [&](const Weight& w) { return w.from != begin->from; });
        double largest = 0, sum = 0;
        for (auto w = begin; w != end; ++w) largest = std::max(largest, w->value);
        for (auto w = begin; w != end; ++w) {
            if (positive) w->value = std::max(w->value, kHalfDigits * largest);
            sum += w->value;
        }
        for (auto w = begin; w != end; ++w) w->value /= sum;
        sums[index(begin->from)] = sum;
        begin = end;
    }
    return sums;
}

/// Row factors that make the matrix nearly symmetric, as multigrid needs.
/// @param sums  sum of each point's weights before normalising. Mean value weights have the unit 1 / length,
///              but cotangents of border points have no unit, so these are divided by a length here.
std::vector<double> evening(const HarmonicProblem& problem, const std::vector<bool>& border,
                            std::span<const Weight> weights, std::vector<double> sums)
{
    if (problem.least_energy) return sums;
    std::vector<double> over_length(sums.size(), 0);
    for (const Weight& w : weights) {
        if (!border[index(w.from)]) continue;
        const double length = (problem.points[index(w.to)] - problem.points[index(w.from)]).norm();
        if (length > 0) over_length[index(w.from)] += w.value / length;
    }
    for (std::size_t p = 0; p < sums.size(); ++p)
        if (over_length[p] > 0) sums[p] *= over_length[p];
    return sums;
}

/// Systems with this number of unknowns or more are solved by multigrid, smaller ones by factorisation.
/// Measured on walls of cylinders at this size: factorisation takes 0.06 s, growing with power 1.5; multigrid
/// takes 0.03 s, growing linearly.
constexpr Eigen::Index kMany = 20000;
/// The same limit if nine digits suffice. Measured at 6,000 unknowns: multigrid takes 0.012 s, factorisation
/// 0.04 s.
constexpr Eigen::Index kManyForNineDigits = 2000;

/// Solve a large system; empty if multigrid does not converge.
/// @param factors  row factors from evening()
std::optional<Eigen::MatrixXd> solve_by_multigrid(const std::vector<Eigen::Triplet<double>>& entries,
                                                  const Eigen::MatrixXd& right,
                                                  const Eigen::VectorXd& factors, const RunContext& context)
{
    Multigrid::Matrix matrix(right.rows(), right.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    for (Eigen::Index row = 0; row < matrix.rows(); ++row)
        for (Multigrid::Matrix::InnerIterator entry(matrix, row); entry; ++entry)
            entry.valueRef() *= factors[row];
    const Multigrid solver(std::move(matrix), context);
    Eigen::MatrixXd solution(right.rows(), right.cols());
    Eigen::VectorXd x;
    for (Eigen::Index k = 0; k < right.cols(); ++k) {
        if (!solver.solve(factors.cwiseProduct(right.col(k)), x, context)) return std::nullopt;
        solution.col(k) = x;
    }
    return solution;
}

Eigen::MatrixXd solve_directly(const std::vector<Eigen::Triplet<double>>& entries,
                               const Eigen::MatrixXd& right, const RunContext& context)
{
    Eigen::SparseMatrix<double> matrix(right.rows(), right.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> solver;
    solver.analyzePattern(matrix);
    check_cancelled(context);
    solver.factorize(matrix);
    check_cancelled(context);
    if (solver.info() != Eigen::Success)
        throw BackendError(Message("geometry.singular", "harmonic values cannot be solved for: {}",
                                   solver.lastErrorMessage())
                               .remedy("check for coordinates that are not numbers"));
    return solver.solve(right);
}

/// The values of an affine function of position that solves the problem: it has the fixed values and, at
/// every free point, equals the weighted mean of its values at the neighbours. Empty if there is none, and
/// for more than three values or with `corner_turns`. Straight walls have such a function, so no system need
/// be solved for them.
/// @param weights  normalised
std::optional<std::vector<Vec3>> affine_values(const HarmonicProblem& problem, std::span<const Index> role,
                                               std::span<const Weight> weights)
{
    const Eigen::Index columns = problem.fixed_values.cols();
    if (columns > 3 || !problem.corner_turns.empty()) return std::nullopt;
    std::vector<Vec3> from, to;
    for (std::size_t i = 0; i < problem.fixed.size(); ++i) {
        from.push_back(problem.points[index(problem.fixed[i])]);
        to.emplace_back(Vec3::Zero());
        to.back().head(columns) = problem.fixed_values.row(static_cast<Eigen::Index>(i)).transpose();
    }
    const AffineFit fit = fit_affine(from, to);
    const Eigen::RowVectorXd range = problem.fixed_values.colwise().maxCoeff() -
                                     problem.fixed_values.colwise().minCoeff();
    const double off = kRoundoff * range.maxCoeff();
    if (!(fit.max_residual <= off)) return std::nullopt;
    std::vector<Vec3> values;
    for (const Vec3& point : problem.points) values.push_back(fit(point));
    std::vector<Vec3> rest = values;
    for (const Weight& w : weights) rest[index(w.from)] -= w.value * values[index(w.to)];
    for (std::size_t p = 0; p < rest.size(); ++p)
        if (role[p] == kFree && !(rest[p].cwiseAbs().maxCoeff() <= off)) return std::nullopt;
    return values;
}

/// Clamp values to the range of the fixed values (fixed × k), as iterative solutions are not exact.
void keep_in_range(const Eigen::MatrixXd& fixed, Eigen::MatrixXd& values)
{
    for (Eigen::Index k = 0; k < values.cols(); ++k)
        values.col(k) = values.col(k).cwiseMax(fixed.col(k).minCoeff()).cwiseMin(fixed.col(k).maxCoeff());
}

/// Solve a problem whose points are all used.
/// @param names  the caller's numbers of the points
Eigen::MatrixXd solve_compact(const HarmonicProblem& problem, std::span<const Index> names,
                              const RunContext& context)
{
    const std::vector<Index> role = roles(problem);
    check_anchored(problem, role, names);
    const Eigen::Index columns = problem.fixed_values.cols();
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(problem.points.size()), columns);

    std::vector<Index> unknown(role.size(), -1), point_of;
    for (std::size_t i = 0; i < role.size(); ++i) {
        if (role[i] >= 0) values.row(static_cast<Eigen::Index>(i)) = problem.fixed_values.row(role[i]);
        if (role[i] != kFree) continue;
        unknown[i] = static_cast<Index>(point_of.size());
        point_of.push_back(static_cast<Index>(i));
    }
    const auto size = static_cast<Eigen::Index>(point_of.size());
    if (size == 0 || columns == 0) return values;

    const std::vector<bool> border = on_border(problem);
    std::vector<Weight> weights = by_point(corner_weights(problem, border), problem.points.size());
    const std::vector<double> sums = normalise(weights, problem.points.size(), !problem.least_energy);
    if (const auto affine = problem.nine_digits ? affine_values(problem, role, weights) : std::nullopt) {
        for (const Index p : point_of) values.row(p) = (*affine)[index(p)].head(columns).transpose();
        return values;
    }
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(weights.size() + point_of.size());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(size, columns);
    for (Index row = 0; row < size; ++row) entries.emplace_back(row, row, 1.0);
    for (const Weight& w : weights) {
        const Index row = unknown[index(w.from)], column = unknown[index(w.to)];
        if (row < 0) continue;
        if (w.turns != 0) right.row(row) += w.value * w.turns * problem.period;
        if (column >= 0)
            entries.emplace_back(row, column, -w.value);
        else
            right.row(row) += w.value * values.row(w.to);
    }
    check_cancelled(context);
    if (size >= (problem.nine_digits ? kManyForNineDigits : kMany)) {
        const std::vector<double> factors = evening(problem, border, weights, sums);
        Eigen::VectorXd row_factors(size);
        for (Index row = 0; row < size; ++row) row_factors[row] = factors[index(point_of[index(row)])];
        if (auto found = solve_by_multigrid(entries, right, row_factors, context)) {
            if (problem.corner_turns.empty() && !problem.least_energy)
                keep_in_range(problem.fixed_values, *found);
            for (Index row = 0; row < size; ++row) values.row(point_of[index(row)]) = found->row(row);
            return values;
        }
    }
    const Eigen::MatrixXd solution = solve_directly(entries, right, context);
    for (Index row = 0; row < size; ++row) values.row(point_of[index(row)]) = solution.row(row);
    return values;
}

} // namespace

HarmonicValues solve_on_facets(const HarmonicProblem& problem, const RunContext& context)
{
    check(problem);
    // Give consecutive numbers to the points that are used: the walls use few points of a large model.
    HarmonicValues result;
    std::vector<Index>& used = result.points;
    for (const Triangle& triangle : problem.triangles)
        used.insert(used.end(), triangle.begin(), triangle.end());
    used.insert(used.end(), problem.fixed.begin(), problem.fixed.end());
    std::ranges::sort(used);
    used.erase(std::ranges::unique(used).begin(), used.end());
    const auto renumber = [&](Index& point) {
        point = static_cast<Index>(std::ranges::lower_bound(used, point) - used.begin());
    };
    HarmonicProblem compact = problem;
    std::vector<Vec3> points;
    for (const Index point : used) points.push_back(problem.points[index(point)]);
    std::vector<Triangle> triangles(problem.triangles.begin(), problem.triangles.end());
    for (Triangle& triangle : triangles) std::ranges::for_each(triangle, renumber);
    std::ranges::for_each(compact.fixed, renumber);
    compact.points = points;
    compact.triangles = triangles;
    result.values = solve_compact(compact, used, context);
    return result;
}

Eigen::MatrixXd solve_harmonic(const HarmonicProblem& problem, const RunContext& context)
{
    const HarmonicValues found = solve_on_facets(problem, context);
    Eigen::MatrixXd values = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(problem.points.size()),
                                                   found.values.cols());
    for (std::size_t i = 0; i < found.points.size(); ++i)
        values.row(found.points[i]) = found.values.row(static_cast<Eigen::Index>(i));
    return values;
}

} // namespace lacuna::geometry
