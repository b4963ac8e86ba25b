// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lacuna/cad/session.h>
#include <lacuna/geometry/exact.h>

#include <memory>
#include <string>
#include <vector>

namespace lacuna::cad {

/// What the exact surfaces and curves of one import share. Gmsh keeps lengths of the file; the model's are
/// `scale` times those.
struct CadSource {
    std::shared_ptr<const GmshModel> model;
    std::string path;
    double scale = 1;    ///< model length / file length
    double diagonal = 0; ///< of the bounding box [file length]
};

/// A rectangle of surface parameters. Where the surface closes on itself, the period is the rectangle's side.
struct ParameterBox {
    Vec2 low = Vec2::Zero(), high = Vec2::Zero();
    std::array<bool, 2> closed{false, false};

    /// Back into the box: round the period where the surface is closed, to the border elsewhere.
    [[nodiscard]] Vec2 bring_in(Vec2 uv) const;
};

/// A face of a Gmsh model.
class CadSurface final : public geometry::ExactSurface {
public:
    CadSurface(std::shared_ptr<const CadSource> source, int tag, const ParameterBox& box)
        : source_(std::move(source)), tag_(tag), box_(box)
    {
    }
    /// Damped Gauss-Newton in the parameters, all points at once; second derivatives where that is too slow.
    void project(std::span<Vec3> points, std::span<Vec2> uv) const override;

    [[nodiscard]] const std::shared_ptr<const CadSource>& source() const { return source_; }
    [[nodiscard]] int tag() const { return tag_; } ///< in the source's Gmsh model

private:
    std::shared_ptr<const CadSource> source_;
    int tag_;
    ParameterBox box_;
};

/// A curve of a Gmsh model.
class CadCurve final : public geometry::ExactCurve {
public:
    CadCurve(std::shared_ptr<const CadSource> source, int tag) : source_(std::move(source)), tag_(tag) {}
    void evaluate(std::span<const double> params, std::span<Vec3> points) const override;

    [[nodiscard]] const std::shared_ptr<const CadSource>& source() const { return source_; }
    [[nodiscard]] int tag() const { return tag_; } ///< in the source's Gmsh model

private:
    std::shared_ptr<const CadSource> source_;
    int tag_;
};

// Gmsh's flat arrays as vectors. Lengths are those of the file; within a session, the model being current.

std::vector<Vec3> curve_points(int tag, const std::vector<double>& params);
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

} // namespace lacuna::cad
