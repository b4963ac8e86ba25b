// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

/// B-splines through points, as a CAD kernel takes them. No Gmsh here.
namespace lacuna::cad {

/// Knots of one parameter in [0, 1], and which value stands where.
struct SplineAxis {
    int degree = 3;
    std::vector<double> knots;       ///< each once, rising
    std::vector<int> multiplicities; ///< of each knot

    /// For `count` values at even parameters: cubic with not-a-knot ends, of lower degree below four values.
    static SplineAxis even(std::size_t count);
    /// For poles over `spans` knot spans of even length: as many as spans + degree.
    static SplineAxis spans(std::size_t spans, int degree);

    [[nodiscard]] std::size_t poles() const;
    /// Values of all basis functions at a parameter.
    [[nodiscard]] Eigen::VectorXd basis(double parameter) const;
};

/// A curve; the first and last pole are its ends.
struct SplineCurve {
    SplineAxis axis;
    std::vector<Vec3> poles;

    [[nodiscard]] Vec3 at(double parameter) const;
};

/// A surface; poles row by row, u running fastest.
struct SplineSurface {
    SplineAxis u, v;
    std::vector<Vec3> poles;
};

/// The curve that meets the points at even parameters.
SplineCurve interpolate(std::span<const Vec3> points);
/// The surface that meets a grid of points, `columns` a row, at even parameters.
SplineSurface interpolate(std::span<const Vec3> grid, std::size_t columns);

/// Places wanted at parameters in [0, 1].
using CurveFunction = std::function<std::vector<Vec3>(std::span<const double>)>;
/// A grid of places: rows of u at each v.
using SurfaceFunction =
    std::function<std::vector<Vec3>(std::span<const double> u, std::span<const double> v)>;

/// Interpolate a function at so many even parameters that halfway between them the spline is within
/// `precision` of it; the most there are where that is not to be had. A straight side gets degree 1.
SplineCurve approximate(const CurveFunction& function, double precision);
SplineSurface approximate(const SurfaceFunction& function, double precision);

} // namespace lacuna::cad
