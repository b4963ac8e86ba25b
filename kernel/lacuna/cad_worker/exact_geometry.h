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

/// A rectangle in the parameter plane. In a direction in which the surface is closed, it covers one period.
struct ParameterBox {
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();
    std::array<bool, 2> closed{false, false};

    /// Move parameters into the box: by periods in closed directions, else to the nearest border.
    [[nodiscard]] Vec2 bring_in(Vec2 uv) const;
};

/// Data that the exact surfaces and curves of one import share. Gmsh stores lengths as in the file; model
/// lengths are `scale` times as large.
struct CadSource {
    std::unique_ptr<const GmshModel> model;
    std::string path;
    double scale = 1;                            ///< model length / file length
    double diagonal = 0;                         ///< diagonal of the bounding box [file length]
    std::unordered_map<int, ParameterBox> boxes; ///< parameter rectangle of every face
};

/// Project points to a face by damped Gauss-Newton steps for all points at once. Second derivatives are added
/// for points that converge slowly.
/// @param points  replaced by their projections [model length].
/// @param uv      start parameters of each point; replaced by the parameters of its projection.
void project_on_face(const CadSource& source, int tag, std::span<Vec3> points, std::span<Vec2> uv);

/// Points of a curve at given parameters of the curve [model length].
std::vector<Vec3> evaluate_curve(const CadSource& source, int tag, const std::vector<double>& params);

// Gmsh's flat arrays as vectors, in file lengths. Call these functions within a session in which the model is
// the current one.

/// The coordinates of points one after the other, as Gmsh takes and returns them.
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
/// reports is not trusted: points of the segment or arc must agree with the curve, up to rounding.
std::vector<Vec3> plain_form(int tag, double first, double last);
std::vector<Vec3> curve_tangents(int tag, const std::vector<double>& params);
std::vector<Vec3> surface_points(int tag, const std::vector<Vec2>& uv);

/// First derivatives of a surface at a point.
struct SurfaceFrame {
    Vec3 du, dv;
};
std::vector<SurfaceFrame> surface_frames(int tag, const std::vector<Vec2>& uv);

/// The normal on the side to which the file orients a face; `du` × `dv` may point to the other side.
Vec3 surface_normal(int tag, const Vec2& uv);

struct SecondDerivatives {
    Vec3 uu, vv, uv;
};
std::vector<SecondDerivatives> surface_second(int tag, const std::vector<Vec2>& uv);

} // namespace lacuna::cad_worker
