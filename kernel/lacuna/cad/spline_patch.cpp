// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/spline_patch.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/dense_solve.h>

#include <algorithm>
#include <utility>

namespace lacuna::cad {

namespace {

/// Degree of splines: their error falls with the sixth power of the interval. Helices with 51 intervals in
/// each turn enclose their volume to 8e-10; with cubic splines, to 1e-6.
constexpr std::size_t kDegree = 5;

std::vector<double> evenly(std::size_t sides)
{
    std::vector<double> parameters(sides + 1);
    for (std::size_t i = 0; i <= sides; ++i)
        parameters[i] = static_cast<double>(i) / static_cast<double>(sides);
    return parameters;
}

/// The basis functions of an axis.
class Basis {
public:
    explicit Basis(const SplineAxisData& axis) : degree_(axis.degree)
    {
        for (std::size_t k = 0; k < axis.knots.size(); ++k)
            flat_.insert(flat_.end(), static_cast<std::size_t>(axis.multiplicities[k]), axis.knots[k]);
    }
    [[nodiscard]] Eigen::Index poles() const { return std::ssize(flat_) - degree_ - 1; }

    /// The basis functions that are not zero at a parameter: the index of the first, and the values of all.
    [[nodiscard]] std::pair<Eigen::Index, Eigen::VectorXd> at(double parameter) const
    {
        const auto knot = [&](Eigen::Index i) { return flat_[static_cast<std::size_t>(i)]; };
        const auto inner = std::span(flat_).subspan(static_cast<std::size_t>(degree_) + 1,
                                                    static_cast<std::size_t>(poles() - degree_) - 1);
        const Eigen::Index span = degree_ + (std::ranges::upper_bound(inner, parameter) - inner.begin());
        // Cox-de Boor recursion, starting from the basis function of degree 0.
        Eigen::VectorXd value = Eigen::VectorXd::Zero(degree_ + 1);
        value[0] = 1;
        for (Eigen::Index d = 1; d <= degree_; ++d) {
            double saved = 0;
            for (Eigen::Index r = 0; r < d; ++r) {
                const double left = parameter - knot(span + 1 + r - d);
                const double right = knot(span + r + 1) - parameter;
                const double part = value[r] / (right + left);
                value[r] = saved + right * part;
                saved = left * part;
            }
            value[d] = saved;
        }
        return {span - degree_, std::move(value)};
    }

private:
    Eigen::Index degree_;
    std::vector<double> flat_; ///< knots, each as often as its multiplicity
};

Vec3 sum_at(const Basis& basis, std::span<const Vec3> poles, double parameter)
{
    const auto [first, weights] = basis.at(parameter);
    Vec3 sum = Vec3::Zero();
    for (Eigen::Index i = 0; i < weights.size(); ++i)
        sum += weights[i] * poles[static_cast<std::size_t>(first + i)];
    return sum;
}

/// The poles of several splines with the same axis that interpolate values at equidistant parameters. Values
/// and poles have one column for each coordinate.
Eigen::MatrixXd poles_through(const SplineAxisData& axis, const Eigen::MatrixXd& values)
{
    const std::vector<double> at = evenly(static_cast<std::size_t>(values.rows()) - 1);
    // Each row of the B-spline matrix has only a few entries near its diagonal, and elimination needs no
    // pivots (de Boor). Column j of row i is stored at j - i + half.
    const Eigen::Index n = values.rows(), half = axis.degree + 1;
    const Basis basis(axis);
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, 2 * half + 1), poles = values;
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto [first, weights] = basis.at(at[static_cast<std::size_t>(i)]);
        rows.row(i).segment(first - i + half, weights.size()) = weights.transpose();
    }
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index width = std::min(half + 1, n - i);
        for (Eigen::Index r = i + 1; r < i + width; ++r) {
            const double factor = rows(r, i - r + half) / rows(i, half);
            rows.row(r).segment(i - r + half, width) -= factor * rows.row(i).segment(half, width);
            poles.row(r) -= factor * poles.row(i);
        }
    }
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        const Eigen::Index width = std::min(half + 1, n - i) - 1;
        poles.row(i) -= rows.row(i).segment(half + 1, width) * poles.middleRows(i + 1, width);
        poles.row(i) /= rows(i, half);
    }
    poles.row(0) = values.row(0); // set exactly, because other splines share these corners
    poles.bottomRows(1) = values.bottomRows(1);
    return poles;
}

Eigen::MatrixXd rows_of(std::span<const Vec3> points)
{
    Eigen::MatrixXd rows(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
        rows.row(static_cast<Eigen::Index>(i)) = points[i].transpose();
    return rows;
}

/// Number of intervals needed to interpolate a function of one parameter. Its values are lists of points.
std::size_t sides_for(const std::function<std::vector<std::vector<Vec3>>(std::span<const double>)>& lines,
                      double precision, std::size_t most)
{
    for (std::size_t sides = 1; sides < most; sides = sides == 1 ? 4 : 2 * sides) {
        const std::vector<double> at = evenly(sides);
        // A single interval suffices only if the quarter points lie on its chord as well.
        std::vector<double> probes;
        for (std::size_t i = 0; i < sides; ++i) probes.push_back((at[i] + at[i + 1]) / 2);
        if (sides == 1) probes = evenly(4);
        const auto values = lines(at);
        const auto wanted = lines(probes);
        bool good = true;
        for (std::size_t line = 0; good && line < values.size(); ++line) {
            const SplineCurveData curve = interpolate(values[line]);
            const Basis basis(curve.axis);
            for (std::size_t i = 0; good && i < probes.size(); ++i)
                good = (sum_at(basis, curve.poles, probes[i]) - wanted[line][i]).norm() <= precision;
        }
        if (good) return sides;
    }
    return most;
}

/// A clamped axis: its end knots have multiplicity degree + 1, so that the spline starts at its first pole
/// and ends at its last.
SplineAxisData clamped_axis(int degree, std::vector<double> knots)
{
    std::vector<int> multiplicities(knots.size(), 1);
    multiplicities.front() = multiplicities.back() = degree + 1;
    return {degree, std::move(knots), std::move(multiplicities)};
}

} // namespace

SplineAxisData even_axis(std::size_t count)
{
    const std::size_t degree = std::min(kDegree, count - 1);
    const std::vector<double> at = evenly(count - 1);
    std::vector<double> knots{0};
    // Not-a-knot: the first and last (degree - 1) / 2 inner parameters are not knots.
    for (std::size_t i = (degree + 2) / 2; i + (degree + 2) / 2 < at.size(); ++i) knots.push_back(at[i]);
    knots.push_back(1);
    return clamped_axis(static_cast<int>(degree), std::move(knots));
}

SplineAxisData axis_of_spans(std::size_t spans, int degree) { return clamped_axis(degree, evenly(spans)); }

Eigen::MatrixXd basis_rows(const SplineAxisData& axis, std::span<const double> parameters)
{
    const Basis basis(axis);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(std::ssize(parameters), basis.poles());
    for (std::size_t i = 0; i < parameters.size(); ++i) {
        const auto [first, values] = basis.at(parameters[i]);
        all.row(static_cast<Eigen::Index>(i)).segment(first, values.size()) = values.transpose();
    }
    return all;
}

Vec3 point_at(const SplineCurveData& curve, double parameter)
{
    return sum_at(Basis(curve.axis), curve.poles, parameter);
}

SplineCurveData interpolate(std::span<const Vec3> points)
{
    SplineCurveData curve{even_axis(points.size()), {}};
    const Eigen::MatrixXd poles = poles_through(curve.axis, rows_of(points));
    for (Eigen::Index i = 0; i < poles.rows(); ++i) curve.poles.emplace_back(poles.row(i));
    return curve;
}

SplineSurfaceData interpolate(std::span<const Vec3> grid, std::size_t columns)
{
    const std::size_t rows = grid.size() / columns;
    SplineSurfaceData surface{even_axis(columns), even_axis(rows), {}};
    // Interpolate each row, then the poles of the rows in the other direction.
    Eigen::MatrixXd values(static_cast<Eigen::Index>(columns), static_cast<Eigen::Index>(3 * rows));
    for (std::size_t j = 0; j < rows; ++j)
        values.middleCols(static_cast<Eigen::Index>(3 * j), 3) = rows_of(grid.subspan(j * columns, columns));
    const Eigen::MatrixXd along = poles_through(surface.u, values);
    Eigen::MatrixXd turned(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(3 * columns));
    for (Eigen::Index j = 0; j < turned.rows(); ++j) {
        for (Eigen::Index i = 0; i < along.rows(); ++i)
            turned.block(j, 3 * i, 1, 3) = along.block(i, 3 * j, 1, 3);
    }
    const Eigen::MatrixXd poles = poles_through(surface.v, turned);
    for (Eigen::Index j = 0; j < poles.rows(); ++j) {
        for (Eigen::Index i = 0; i < along.rows(); ++i)
            surface.poles.emplace_back(poles.block(j, 3 * i, 1, 3).transpose());
    }
    return surface;
}

SplineCurveData approximate(const CurveFunction& function, double precision, std::size_t most)
{
    const std::size_t sides = sides_for(
        [&](std::span<const double> at) { return std::vector<std::vector<Vec3>>{function(at)}; }, precision,
        most);
    return interpolate(function(evenly(sides)));
}

SplineSurfaceData approximate(const SurfaceFunction& function, double precision, std::size_t most)
{
    const std::vector<double> across = evenly(kSamplesPerSide);
    const auto lines_along_u = [&](std::span<const double> at) {
        const std::vector<Vec3> grid = function(at, across);
        std::vector<std::vector<Vec3>> lines;
        for (std::size_t j = 0; j < across.size(); ++j)
            lines.emplace_back(grid.begin() + static_cast<std::ptrdiff_t>(j * at.size()),
                               grid.begin() + static_cast<std::ptrdiff_t>((j + 1) * at.size()));
        return lines;
    };
    const auto lines_along_v = [&](std::span<const double> at) {
        const std::vector<Vec3> grid = function(across, at);
        std::vector<std::vector<Vec3>> lines(across.size());
        for (std::size_t k = 0; k < grid.size(); ++k) lines[k % across.size()].push_back(grid[k]);
        return lines;
    };
    const std::vector<double> u = evenly(sides_for(lines_along_u, precision, most));
    const std::vector<double> v = evenly(sides_for(lines_along_v, precision, most));
    return interpolate(function(u, v), u.size());
}

} // namespace lacuna::cad
