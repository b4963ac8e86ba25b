// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/cad_protocol/shared/messages.h>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

/// Interpolating B-splines in the form that a CAD kernel uses. Independent of Gmsh.
namespace lacuna::cad {

using cad_protocol::SplineAxisData;
using cad_protocol::SplineCurveData;
using cad_protocol::SplineSurfaceData;

/// Degree and knots of a spline in one direction that interpolates `count` values at equidistant parameters
/// in [0, 1]: of degree 5 with not-a-knot ends, or of lower degree if there are fewer than six values.
SplineAxisData even_axis(std::size_t count);
/// Axis with `spans` knot spans of equal length in [0, 1]; it has spans + degree poles.
SplineAxisData axis_of_spans(std::size_t spans, int degree);
/// The values of all basis functions at several parameters: one row for each parameter.
Eigen::MatrixXd basis_rows(const SplineAxisData& axis, std::span<const double> parameters);
Vec3 point_at(const SplineCurveData& curve, double parameter);

/// The curve that interpolates the points at equidistant parameters.
SplineCurveData interpolate(std::span<const Vec3> points);
/// The surface that interpolates a grid of points, `columns` in each row, at equidistant parameters.
SplineSurfaceData interpolate(std::span<const Vec3> grid, std::size_t columns);

/// Evaluates a curve at parameters in [0, 1].
using CurveFunction = std::function<std::vector<Vec3>(std::span<const double>)>;
/// Evaluates a surface on a grid: for each v, one row of points along u.
using SurfaceFunction =
    std::function<std::vector<Vec3>(std::span<const double> u, std::span<const double> v)>;

/// Default limit on the intervals between the interpolated points of a spline: enough for ten turns.
inline constexpr std::size_t kMostIntervals = 512;
/// Interpolate a function at equidistant parameters. The number of intervals is doubled until the spline
/// deviates by at most `precision` half way between the points, or until there are `most` intervals. A
/// straight line gets degree 1.
SplineCurveData approximate(const CurveFunction& function, double precision,
                            std::size_t most = kMostIntervals);
SplineSurfaceData approximate(const SurfaceFunction& function, double precision,
                              std::size_t most = kMostIntervals);

} // namespace lacuna::cad
