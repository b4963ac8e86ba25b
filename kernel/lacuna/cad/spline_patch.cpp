// SPDX-License-Identifier: MIT
#include <lacuna/cad/detail/spline_patch.h>

#include <lacuna/geometry/shared/dense_solve.h>

#include <algorithm>
#include <utility>

namespace lacuna::cad {

namespace {

/// Degree of splines: their error falls with the sixth power of the interval. Measured on ten turns of a
/// helix with 512 intervals: the error of the enclosed volume is 8e-10, and 1e-6 with cubic splines.
constexpr std::size_t kDegree = 5;
/// Limit on the intervals between the interpolated points of a spline.
constexpr std::size_t kMostSides = 512;
/// Number of lines in each direction along which a surface is probed.
constexpr std::size_t kProbes = 5;

std::vector<double> evenly(std::size_t sides)
{
    std::vector<double> parameters(sides + 1);
    for (std::size_t i = 0; i <= sides; ++i)
        parameters[i] = static_cast<double>(i) / static_cast<double>(sides);
    return parameters;
}

/// The poles of several splines with the same axis that interpolate values at equidistant parameters. Values
/// and poles have one column for each coordinate.
Eigen::MatrixXd poles_through(const SplineAxisData& axis, const Eigen::MatrixXd& values)
{
    const std::vector<double> at = evenly(static_cast<std::size_t>(values.rows()) - 1);
    // Each row of the B-spline matrix has only a few entries near its diagonal, and elimination needs no
    // pivots (de Boor).
    Eigen::MatrixXd rows = basis_rows(axis, at), poles = values;
    const Eigen::Index n = rows.rows(), band = axis.degree + 2;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::Index width = std::min(band, n - i);
        for (Eigen::Index r = i + 1; r < i + width; ++r) {
            const double factor = rows(r, i) / rows(i, i);
            rows.row(r).segment(i, width) -= factor * rows.row(i).segment(i, width);
            poles.row(r) -= factor * poles.row(i);
        }
    }
    for (Eigen::Index i = n - 1; i >= 0; --i) {
        const Eigen::Index width = std::min(band, n - i) - 1;
        poles.row(i) -= rows.row(i).segment(i + 1, width) * poles.middleRows(i + 1, width);
        poles.row(i) /= rows(i, i);
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
                      double precision)
{
    for (std::size_t sides = 1; sides < kMostSides; sides = sides == 1 ? 4 : 2 * sides) {
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
            for (std::size_t i = 0; good && i < probes.size(); ++i)
                good = (point_at(curve, probes[i]) - wanted[line][i]).norm() <= precision;
        }
        if (good) return sides;
    }
    return kMostSides;
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

Eigen::VectorXd basis(const SplineAxisData& axis, double parameter)
{
    std::vector<double> flat;
    for (std::size_t k = 0; k < axis.knots.size(); ++k)
        flat.insert(flat.end(), static_cast<std::size_t>(axis.multiplicities[k]), axis.knots[k]);
    const auto p = static_cast<std::size_t>(axis.degree);
    std::size_t span = p;
    while (span + p + 2 < flat.size() && parameter >= flat[span + 1]) ++span;
    // Cox-de Boor recursion, starting from the basis function of degree 0.
    std::vector<double> value(p + 1, 0.0);
    value[0] = 1;
    for (std::size_t d = 1; d <= p; ++d) {
        double saved = 0;
        for (std::size_t r = 0; r < d; ++r) {
            const double left = parameter - flat[span + 1 + r - d];
            const double right = flat[span + r + 1] - parameter;
            const double part = value[r] / (right + left);
            value[r] = saved + right * part;
            saved = left * part;
        }
        value[d] = saved;
    }
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(flat.size() - p - 1));
    for (std::size_t r = 0; r <= p; ++r) all[static_cast<Eigen::Index>(span - p + r)] = value[r];
    return all;
}

Eigen::MatrixXd basis_rows(const SplineAxisData& axis, std::span<const double> parameters)
{
    std::vector<Eigen::VectorXd> rows;
    for (const double parameter : parameters) rows.push_back(basis(axis, parameter));
    Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), rows.front().size());
    for (Eigen::Index i = 0; i < all.rows(); ++i) all.row(i) = rows[static_cast<std::size_t>(i)].transpose();
    return all;
}

Vec3 point_at(const SplineCurveData& curve, double parameter)
{
    const Eigen::VectorXd weight = basis(curve.axis, parameter);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < curve.poles.size(); ++i)
        sum += weight[static_cast<Eigen::Index>(i)] * curve.poles[i];
    return sum;
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

SplineCurveData approximate(const CurveFunction& function, double precision)
{
    const std::size_t sides = sides_for(
        [&](std::span<const double> at) { return std::vector<std::vector<Vec3>>{function(at)}; }, precision);
    return interpolate(function(evenly(sides)));
}

SplineSurfaceData approximate(const SurfaceFunction& function, double precision)
{
    const std::vector<double> across = evenly(kProbes - 1);
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
    const std::vector<double> u = evenly(sides_for(lines_along_u, precision));
    const std::vector<double> v = evenly(sides_for(lines_along_v, precision));
    return interpolate(function(u, v), u.size());
}

} // namespace lacuna::cad
