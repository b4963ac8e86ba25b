// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/detail/cad_facets.h>
#include <lacuna/cad_worker/detail/gmsh_api.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/spread.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace lacuna::cad_worker {

namespace {

/// Principal curvatures of a surface at a point; |first| >= |second|.
struct Bend {
    Vec3 at, normal;
    double first = 0, second = 0; ///< principal curvatures, positive if the centre is on the normal side
    [[nodiscard]] Vec3 centre(double curvature) const { return at + normal / curvature; }
};

std::vector<Bend> bends_of(int tag, const ParameterBox& box)
{
    std::vector<Vec2> uv;
    for (int i = 0; i < kSamplesPerSide; ++i) {
        for (int j = 0; j < kSamplesPerSide; ++j) {
            uv.push_back(box.low +
                         (box.high - box.low)
                             .cwiseProduct(Vec2((i + 0.4) / kSamplesPerSide, (j + 0.6) / kSamplesPerSide)));
        }
    }
    const std::vector<Vec3> at = surface_points(tag, uv);
    const std::vector<SurfaceFrame> frames = surface_frames(tag, uv);
    const std::vector<SecondDerivatives> second = surface_second(tag, uv);
    std::vector<Bend> bends;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        const SurfaceFrame& f = frames[i];
        const Vec3 n = f.du.cross(f.dv).normalized();
        Eigen::Matrix2d metric, shape;
        metric << f.du.dot(f.du), f.du.dot(f.dv), f.du.dot(f.dv), f.dv.dot(f.dv);
        shape << n.dot(second[i].uu), n.dot(second[i].uv), n.dot(second[i].uv), n.dot(second[i].vv);
        if (!(metric.determinant() > 0)) continue;
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> solver(shape, metric,
                                                                               Eigen::EigenvaluesOnly);
        double a = solver.eigenvalues()[0];
        double b = solver.eigenvalues()[1];
        if (std::abs(a) < std::abs(b)) std::swap(a, b);
        bends.push_back({at[i], n, a, b});
    }
    return bends;
}

/// Whether all points are collinear, within `precision` times `size`.
bool collinear(const std::vector<Vec3>& points, double size, double precision)
{
    return std::sqrt(std::max(0.0, geometry::spread_of(points).square[1])) <= precision * size;
}

std::string kind_by_bending(int tag, const ParameterBox& box)
{
    // Gmsh computes some second derivatives by finite differences, whose errors are about this large.
    constexpr double kBendPrecision = 1e-4;
    const std::vector<Bend> bends = bends_of(tag, box);
    if (bends.empty()) return "surface";
    Eigen::AlignedBox3d bounds;
    for (const Bend& b : bends) bounds.extend(b.at);
    const double size = bounds.diagonal().norm();
    const auto none = [&](double curvature) { return std::abs(curvature) * size < kBendPrecision; };
    const auto alike = [&](double a, double b) {
        return std::abs(a - b) <= kBendPrecision * std::max(std::abs(a), std::abs(b));
    };
    const auto all = [&](auto&& test) { return std::all_of(bends.begin(), bends.end(), test); };
    const Bend& one = bends.front();

    if (all([&](const Bend& b) { return none(b.first); })) return "plane";
    if (all([&](const Bend& b) { return none(b.second); })) {
        if (all([&](const Bend& b) { return alike(b.first, one.first); })) return "cylinder";
        std::vector<Vec3> centres;
        for (const Bend& b : bends) {
            if (none(b.first)) return "surface";
            centres.push_back(b.centre(b.first));
        }
        return collinear(centres, size, kBendPrecision) ? "cone" : "surface";
    }
    if (all([&](const Bend& b) { return alike(b.first, one.first) && alike(b.second, one.first); }))
        return "sphere";
    // On a torus, one of the two principal curvatures is constant.
    for (const double constant : {one.first, one.second}) {
        if (none(constant)) continue;
        std::vector<Vec3> centres;
        bool matches = true;
        for (const Bend& b : bends) {
            const bool first = alike(b.first, constant);
            if (!first && !alike(b.second, constant)) {
                matches = false;
                break;
            }
            const double other = first ? b.second : b.first;
            if (std::abs(other) * size > 0.05) centres.push_back(b.centre(other));
        }
        if (matches && centres.size() > 2 && collinear(centres, size, kBendPrecision)) return "torus";
    }
    return "surface";
}

} // namespace

std::string kind_of_face(int tag, const ParameterBox& box)
{
    const std::string type = gmsh_type(2, tag);
    for (const auto& [word, kind] :
         {std::pair("Plane", "plane"), std::pair("Cylinder", "cylinder"), std::pair("Cone", "cone"),
          std::pair("Sphere", "sphere"), std::pair("Torus", "torus"), std::pair("BSpline surface", "bspline"),
          std::pair("Bezier surface", "bspline")}) {
        if (type == word) return kind;
    }
    return kind_by_bending(tag, box);
}

} // namespace lacuna::cad_worker
