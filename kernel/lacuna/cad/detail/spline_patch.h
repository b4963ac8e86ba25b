// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

/// Interpolating B-splines in the form that a CAD kernel uses. Independent of Gmsh.
namespace lacuna::cad {

/// The knot vector of one parameter in [0, 1], and the parameters of the interpolated values.
struct SplineAxis {
    int degree = 3;
    std::vector<double> knots;       ///< distinct, ascending
    std::vector<int> multiplicities; ///< one for each knot

    /// Axis for `count` values at equidistant parameters: cubic, with not-a-knot ends; of lower degree if
    /// there are fewer than four values.
    static SplineAxis even(std::size_t count);
    /// Axis with `spans` knot spans of equal length; it has spans + degree poles.
    static SplineAxis spans(std::size_t spans, int degree);

    [[nodiscard]] std::size_t poles() const;
    /// Values of all basis functions at a parameter.
    [[nodiscard]] Eigen::VectorXd basis(double parameter) const;
};

/// A spline curve; its first and last pole are its end points.
struct SplineCurve {
    SplineAxis axis;
    std::vector<Vec3> poles;

    [[nodiscard]] Vec3 at(double parameter) const;
};

/// A spline surface; poles row by row, u running fastest.
struct SplineSurface {
    SplineAxis u, v;
    std::vector<Vec3> poles;
};

/// The curve that interpolates the points at equidistant parameters.
SplineCurve interpolate(std::span<const Vec3> points);
/// The surface that interpolates a grid of points, `columns` in each row, at equidistant parameters.
SplineSurface interpolate(std::span<const Vec3> grid, std::size_t columns);

/// Evaluates a curve at parameters in [0, 1].
using CurveFunction = std::function<std::vector<Vec3>(std::span<const double>)>;
/// Evaluates a surface on a grid: one row of u for each v.
using SurfaceFunction =
    std::function<std::vector<Vec3>(std::span<const double> u, std::span<const double> v)>;

/// Interpolate a function at as many equidistant parameters as it takes for the spline to be within
/// `precision` halfway between them, up to a fixed maximum. A straight line gets degree 1.
SplineCurve approximate(const CurveFunction& function, double precision);
SplineSurface approximate(const SurfaceFunction& function, double precision);

} // namespace lacuna::cad
