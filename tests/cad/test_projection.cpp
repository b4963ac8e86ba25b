// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"

#include <doctest/doctest.h>
#include <gmsh.h>

#include <cmath>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// Centres and near-corner points of every facet, pushed off it, with the parameters interpolated.
struct Cloud {
    std::vector<Vec3> points;
    std::vector<Vec2> uv;
};

Cloud around_facets(const topology::Model& model, const topology::Face& face, double offset)
{
    Cloud cloud;
    for (std::size_t t = 0; t < face.triangles.size(); ++t) {
        const Triangle& f = face.triangles[t];
        const Vec3 n = (model.at(f[1]) - model.at(f[0])).cross(model.at(f[2]) - model.at(f[0])).normalized();
        for (const Vec3& w : {Vec3(1, 1, 1), Vec3(8, 1, 1), Vec3(1, 8, 1), Vec3(1, 1, 8)}) {
            const Vec3 b = w / w.sum();
            cloud.points.push_back(b[0] * model.at(f[0]) + b[1] * model.at(f[1]) + b[2] * model.at(f[2]) +
                                   offset * n);
            cloud.uv.push_back(b[0] * face.uv[t][0] + b[1] * face.uv[t][1] + b[2] * face.uv[t][2]);
        }
    }
    return cloud;
}

/// Distance to an analytic surface, and its closest point.
using Closest = std::function<Vec3(const Vec3&)>;

} // namespace

TEST_CASE(
    "projection finds the closest point of round surfaces, from either side, all around seams and poles")
{
    const test::TempFolder folder;
    struct Case {
        const char* name;
        std::function<void()> build;
        std::string kind;
        Closest closest;
    };
    const Vec3 axis = Vec3::UnitZ();
    const std::vector<Case> cases{
        {"sphere", [] { occ::addSphere(0, 0, 0, 2); }, "sphere",
         [](const Vec3& p) { return Vec3(2 * p.normalized()); }},
        {"cylinder", [] { occ::addCylinder(0, 0, 0, 0, 0, 9, 2); }, "cylinder",
         [](const Vec3& p) {
             return Vec3(2 * Vec3(p.x(), p.y(), 0).normalized() +
                         std::clamp(p.z(), 0.0, 9.0) * Vec3::UnitZ());
         }},
        {"torus", [] { occ::addTorus(0, 0, 0, 5, 2); }, "torus",
         [](const Vec3& p) {
             const Vec3 ring = 5 * Vec3(p.x(), p.y(), 0).normalized();
             return Vec3(ring + 2 * (p - ring).normalized());
         }},
        {"cone", [] { occ::addCone(0, 0, 0, 0, 0, 2, 2, 0); }, "cone",
         [](const Vec3& p) {
             const Vec3 out = Vec3(p.x(), p.y(), 0).normalized();
             const Vec3 side = (Vec3(0, 0, 2) - 2 * out).normalized(); // from the rim to the apex
             const double s = std::clamp((p - 2 * out).dot(side), 0.0, 2 * std::sqrt(2.0));
             return Vec3(2 * out + s * side);
         }},
    };
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const topology::Model model = cad::load({folder.gmsh("round.brep", c.build)});
        bool found = false;
        for (const topology::Face& face : model.faces) {
            if (face.kind != c.kind) continue;
            found = true;
            for (const double offset : {0.0, 0.2, -0.2}) {
                CAPTURE(offset);
                Cloud cloud = around_facets(model, face, offset);
                const std::vector<Vec3> before = cloud.points;
                face.surface->project(cloud.points, cloud.uv);
                for (std::size_t i = 0; i < before.size(); ++i) {
                    CHECK((cloud.points[i] - c.closest(before[i])).norm() < 1e-8 * model.diagonal);
                }
                // What came out goes back to itself from its own parameters.
                std::vector<Vec3> again = cloud.points;
                face.surface->project(again, cloud.uv);
                for (std::size_t i = 0; i < again.size(); ++i)
                    CHECK((again[i] - cloud.points[i]).norm() < 1e-9 * model.diagonal);
            }
        }
        CHECK(found);
    }
    (void)axis;
}

TEST_CASE("the parameters of a facet corner evaluate to the corner, on the facet's own side of a seam")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        CAPTURE(shape.name);
        const topology::Model model = cad::load({folder.gmsh("shape.step", shape.build)});
        for (const topology::Face& face : model.faces) {
            Eigen::AlignedBox2d box;
            for (const auto& uv : face.uv) {
                for (const Vec2& corner : uv) box.extend(corner);
            }
            std::vector<Vec3> points;
            std::vector<Vec2> uv;
            for (std::size_t t = 0; t < face.triangles.size(); ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    points.push_back(model.at(face.triangles[t][k]));
                    uv.push_back(face.uv[t][k]);
                    // A facet that took the wrong side of a seam would span the rectangle.
                    const Vec2 side = face.uv[t][(k + 1) % 3] - face.uv[t][k];
                    if (face.triangles.size() > 16)
                        CHECK((side.cwiseAbs().cwiseQuotient(box.sizes())).maxCoeff() < 0.7);
                }
                const Vec2 a = face.uv[t][1] - face.uv[t][0];
                const Vec2 b = face.uv[t][2] - face.uv[t][0];
                CHECK(a.x() * b.y() - a.y() * b.x() != 0);
            }
            const std::vector<Vec3> before = points;
            face.surface->project(points, uv);
            for (std::size_t i = 0; i < points.size(); ++i)
                CHECK((points[i] - before[i]).norm() < 1e-9 * model.diagonal);
        }
    }
}

TEST_CASE("edge points lie on their exact curve at their own parameters, which rise or fall along the edge")
{
    const test::TempFolder folder;
    for (const test::KnownShape& shape : test::known_shapes()) {
        CAPTURE(shape.name);
        const topology::Model model = cad::load({folder.gmsh("shape.step", shape.build)});
        for (const topology::Edge& edge : model.edges) {
            std::vector<Vec3> points(edge.params.size());
            edge.curve->evaluate(edge.params, points);
            for (std::size_t i = 0; i < points.size(); ++i) {
                CHECK((points[i] - model.at(edge.points[i])).norm() < 1e-9 * model.diagonal);
                if (i > 0)
                    CHECK((edge.params[i] - edge.params[i - 1]) * (edge.params.back() - edge.params.front()) >
                          0);
            }
        }
    }
}

TEST_CASE("exact geometry outlives the load, the model and other loads")
{
    const test::TempFolder folder;
    const std::string path = folder.gmsh("sphere.step", [] { occ::addSphere(0, 0, 0, 1); });
    std::shared_ptr<const geometry::ExactSurface> surface;
    {
        const topology::Model model = cad::load({path});
        surface = model.faces[0].surface;
    }
    for (int i = 0; i < 3; ++i) (void)cad::load({path});
    std::vector<Vec3> points{{0.9, 0.9, 0.1}};
    std::vector<Vec2> uv{{0.5, 0.1}};
    surface->project(points, uv);
    CHECK(points[0].norm() == doctest::Approx(1));
}

TEST_CASE("a start at a pole finds a point on the far side of it")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("sphere.step", [] { occ::addSphere(0, 0, 0, 1); })});
    const double pole = 1.5707963267948966;
    for (const double angle : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) {
        const Vec3 target = Vec3(0.1 * std::cos(angle), 0.1 * std::sin(angle), 1).normalized();
        std::vector<Vec3> points{1.05 * target};
        std::vector<Vec2> uv{{0.0, pole}};
        model.faces[0].surface->project(points, uv);
        CHECK((points[0] - target).norm() < 1e-9);
    }
}

TEST_CASE("points that are not finite are refused")
{
    const test::TempFolder folder;
    const topology::Model model = cad::load({folder.gmsh("sphere.step", [] { occ::addSphere(0, 0, 0, 1); })});
    std::vector<Vec3> points{{std::nan(""), 0, 0}};
    std::vector<Vec2> uv{{0, 0}};
    CHECK_THROWS_AS(model.faces[0].surface->project(points, uv), BackendError);
}
