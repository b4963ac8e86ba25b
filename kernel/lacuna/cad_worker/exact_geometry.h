// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad_worker/session.h>
#include <lacuna/core/types.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace lacuna::cad_worker {

/// A rectangle in the parameter plane. If the surface is closed, its side is one period.
struct ParameterBox {
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();
    std::array<bool, 2> closed{false, false};

    /// Move parameters into the box: by periods if the surface is closed, else to the nearest border.
    [[nodiscard]] Vec2 bring_in(Vec2 uv) const;
};

/// Data shared by the exact surfaces and curves of one import. Gmsh stores lengths of the file; model lengths
/// are `scale` times as large.
struct CadSource {
    std::unique_ptr<const GmshModel> model;
    std::string path;
    double scale = 1;                            ///< model length / file length
    double diagonal = 0;                         ///< of the bounding box [file length]
    std::unordered_map<int, ParameterBox> boxes; ///< for every face
};

/// Project points to a face, each near its start parameters: damped Gauss-Newton on all points at once, with
/// second derivatives if it converges slowly.
/// @param points  in and out [model length].
void project_on_face(const CadSource& source, int tag, std::span<Vec3> points, std::span<Vec2> uv);

/// Points of a curve at its own parameters [model length].
std::vector<Vec3> evaluate_curve(const CadSource& source, int tag, const std::vector<double>& params);

// Gmsh's flat arrays converted to vectors, in file lengths. Call within a session, with the model current.

/// The coordinates of points in a row, as Gmsh takes and returns them.
template <class Vec>
std::vector<double> flat(const std::vector<Vec>& points)
{
    std::vector<double> values;
    values.reserve(points.size() * Vec::SizeAtCompileTime);
    for (const Vec& p : points) values.insert(values.end(), p.begin(), p.end());
    return values;
}
template <int dimension>
std::vector<Eigen::Matrix<double, dimension, 1>> unflat(const std::vector<double>& values)
{
    std::vector<Eigen::Matrix<double, dimension, 1>> points(values.size() / dimension);
    for (std::size_t i = 0; i < values.size(); ++i)
        points[i / dimension][static_cast<Eigen::Index>(i % dimension)] = values[i];
    return points;
}

std::vector<Vec3> curve_points(int tag, const std::vector<double>& params);
/// Defining points of a curve that is a line segment or an elliptic arc; else empty. The type that Gmsh
/// reports is not trusted: the form is compared with the curve, up to rounding.
std::vector<Vec3> plain_form(int tag, double first, double last);
std::vector<Vec3> curve_tangents(int tag, const std::vector<double>& params);
std::vector<Vec3> surface_points(int tag, const std::vector<Vec2>& uv);

/// First derivatives of a surface at a point.
struct SurfaceFrame {
    Vec3 du, dv;
};
std::vector<SurfaceFrame> surface_frames(int tag, const std::vector<Vec2>& uv);

struct SecondDerivatives {
    Vec3 uu, vv, uv;
};
std::vector<SecondDerivatives> surface_second(int tag, const std::vector<Vec2>& uv);

} // namespace lacuna::cad_worker
