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

/// A rectangle of surface parameters. Where the surface closes on itself, the period is the rectangle's side.
struct ParameterBox {
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();
    std::array<bool, 2> closed{false, false};

    /// Back into the box: round the period where the surface is closed, to the border elsewhere.
    [[nodiscard]] Vec2 bring_in(Vec2 uv) const;
};

/// What the exact surfaces and curves of one import share. Gmsh keeps lengths of the file; the model's are
/// `scale` times those.
struct CadSource {
    std::unique_ptr<const GmshModel> model;
    std::string path;
    double scale = 1;                            ///< model length / file length
    double diagonal = 0;                         ///< of the bounding box [file length]
    std::unordered_map<int, ParameterBox> boxes; ///< of every face
};

/// Move each point to the closest point of a face near its start parameter: damped Gauss-Newton in the
/// parameters, all points at once; second derivatives where that is too slow.
/// @param points  in and out [model length].
void project_on_face(const CadSource& source, int tag, std::span<Vec3> points, std::span<Vec2> uv);

/// Points of a curve at its own parameters [model length].
std::vector<Vec3> evaluate_curve(const CadSource& source, int tag, const std::vector<double>& params);

// Gmsh's flat arrays as vectors. Lengths are those of the file; within a session, the model being current.

std::vector<Vec3> curve_points(int tag, const std::vector<double>& params);
/// The form of a curve that is a straight line or an ellipse from one parameter to another; else nothing. Not
/// by its kind alone: it is compared with the curve, to rounding.
std::vector<Vec3> plain_form(int tag, double first, double last);
std::vector<Vec3> curve_tangents(int tag, const std::vector<double>& params);
std::vector<Vec3> surface_points(int tag, const std::vector<Vec2>& uv);

/// First derivatives at each place.
struct SurfaceFrame {
    Vec3 du, dv;
};
std::vector<SurfaceFrame> surface_frames(int tag, const std::vector<Vec2>& uv);

struct SecondDerivatives {
    Vec3 uu, vv, uv;
};
std::vector<SecondDerivatives> surface_second(int tag, const std::vector<Vec2>& uv);

} // namespace lacuna::cad_worker
