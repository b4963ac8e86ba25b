// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/dice.h"

#include <lacuna/surface/shared/projector.h>
#include <lacuna/topology/open_volume.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// A round hole, as the cylinder that was cut out: all of the face lies outside it.
struct Hole {
    Vec3 on_axis, axis;
    double radius = 0;

    [[nodiscard]] double distance(const Vec3& p) const
    {
        const Vec3 d = p - on_axis;
        if (d.dot(axis) < 0) return std::numeric_limits<double>::infinity();
        return (d - d.dot(axis) * axis).norm();
    }
};

struct Trimmed {
    std::string name, kind;
    std::function<void(double)> build; ///< at a size
    Hole hole;                         ///< at size 1
};

void pierce(int solid, double size, const Hole& hole)
{
    const Vec3 from = size * hole.on_axis, way = size * 9 * hole.axis;
    gmsh::vectorpair out;
    std::vector<gmsh::vectorpair> map;
    occ::cut(
        {{3, solid}},
        {{3, occ::addCylinder(from.x(), from.y(), from.z(), way.x(), way.y(), way.z(), size * hole.radius)}},
        out, map);
}

/// Planes, cylinders, spheres, cones and tori with a hole: clear of the seam, over it, and at a pole.
std::vector<Trimmed> trimmed_faces()
{
    std::vector<Trimmed> all;
    const auto add = [&](const std::string& name, const std::string& kind,
                         const std::function<int(double)>& solid, const Hole& hole) {
        all.push_back({name, kind, [=](double s) { pierce(solid(s), s, hole); }, hole});
    };
    const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
    const auto box = [](double s) { return occ::addBox(-2 * s, -2 * s, -s, 4 * s, 4 * s, s); };
    const auto cylinder = [](double s) { return occ::addCylinder(0, 0, -2 * s, 0, 0, 4 * s, s); };
    const auto sphere = [](double s) { return occ::addSphere(0, 0, 0, s); };
    const auto cone = [](double s) { return occ::addCone(0, 0, -s, 0, 0, 2 * s, 1.5 * s, 0.5 * s); };
    const auto torus = [](double s) { return occ::addTorus(0, 0, 0, 2 * s, 0.7 * s); };
    add("plane", "plane", box, {Vec3(0.3, 0.2, -4), z, 0.8});
    add("cylinder beside its seam", "cylinder", cylinder, {Vec3::Zero(), y, 0.5});
    add("cylinder at its seam", "cylinder", cylinder, {Vec3::Zero(), x, 0.5});
    add("sphere beside its seam", "sphere", sphere, {Vec3::Zero(), y, 0.4});
    add("sphere at its seam", "sphere", sphere, {Vec3::Zero(), x, 0.4});
    add("sphere at its pole", "sphere", sphere, {Vec3::Zero(), z, 0.4});
    add("cone at its seam", "cone", cone, {Vec3::Zero(), x, 0.3});
    add("torus beside its seams", "torus", torus, {Vec3(1.4, 1.4, -4), z, 0.3});
    return all;
}

/// The hole's own wall is a cylinder as well: what is asked for is the larger face.
FaceId pierced_face(const topology::Model& model, const std::string& kind)
{
    FaceId found;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const FaceId face(f);
        if (model[face].kind != kind || topology::border_loops(model, face).empty()) continue;
        if (!found.valid() || topology::face_area(model, face) > topology::face_area(model, found))
            found = face;
    }
    REQUIRE(found.valid());
    return found;
}

double distance_to_border(const topology::Model& model, FaceId face, const Vec3& p)
{
    double least = std::numeric_limits<double>::infinity();
    for (const topology::Loop& loop : topology::border_loops(model, face)) {
        for (const topology::EdgeUse& use : loop.uses) {
            const topology::Edge& edge = model[use.edge];
            std::vector<double> params;
            for (int i = 0; i <= 2000; ++i)
                params.push_back(edge.params.front() + (edge.params.back() - edge.params.front()) * i / 2000);
            std::vector<Vec3> at(params.size());
            edge.curve->evaluate(params, at);
            for (const Vec3& q : at) least = std::min(least, (p - q).norm());
        }
    }
    return least;
}

} // namespace

TEST_CASE("a point projected on a trimmed face stays on it, at the border's curve where the surface goes on")
{
    const test::TempFolder folder;
    for (const Trimmed& shape : trimmed_faces()) {
        for (const double size : {1e-3, 1.0, 1e3}) {
            CAPTURE(shape.name);
            CAPTURE(size);
            const topology::Model model = cad::load(
                {folder.gmsh("trimmed.brep", [&] { shape.build(size); })});
            const FaceId face = pierced_face(model, shape.kind);
            const surface::Projector projector(model, {face});
            Hole hole = shape.hole;
            hole.on_axis *= size;
            hole.radius *= size;

            // Points in the hole, at its rim, and all around the face.
            test::Dice dice(7);
            std::vector<Vec3> points;
            const topology::Face& f = model[face];
            for (const Triangle& t : f.triangles) {
                const Vec3 middle = (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3;
                const auto off = [&] { return 0.02 * size * dice.between(-1, 1); };
                points.push_back(middle + Vec3(off(), off(), off()));
            }
            const std::size_t on_face = points.size();
            for (const topology::Loop& loop : topology::border_loops(model, face)) {
                for (const topology::EdgeUse& use : loop.uses) {
                    for (const Index p : model[use.edge].points) {
                        const Vec3& at = model.at(p);
                        const Vec3 d = at - hole.on_axis;
                        const Vec3 axis_point = hole.on_axis + d.dot(hole.axis) * hole.axis;
                        if (std::abs((at - axis_point).norm() - hole.radius) > 1e-6 * size) continue;
                        for (const double in : {0.02, 0.3, 0.7})
                            points.push_back(at + in * (axis_point - at));
                    }
                }
            }
            REQUIRE(points.size() > on_face + 20);
            const std::vector<Vec3> before = points;
            projector.project(points);
            double deepest = 0, farthest = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                deepest = std::max(deepest, hole.radius - hole.distance(points[i]));
                if (i >= on_face && i % 7 == 0)
                    farthest = std::max(farthest, distance_to_border(model, face, points[i]));
            }
            // Where two surfaces meet the curve is approximated, to 1e-7 of a file's length.
            CHECK(deepest < 1e-8 * model.diagonal + 2e-8);
            CHECK(farthest < 2e-3 * size); // the border is sampled
            // What is on the face already stays where it is.
            std::vector<Vec3> again = points;
            projector.project(again);
            for (std::size_t i = 0; i < points.size(); ++i)
                CHECK((again[i] - points[i]).norm() < 1e-8 * model.diagonal + 2e-8);
        }
    }
}

TEST_CASE("the border of a face pushes no point that is inside of it, however near or bent the border is")
{
    const test::TempFolder folder;
    for (const Trimmed& shape : trimmed_faces()) {
        CAPTURE(shape.name);
        const topology::Model model = cad::load({folder.gmsh("trimmed.brep", [&] { shape.build(1); })});
        const FaceId face = pierced_face(model, shape.kind);
        const topology::Face& f = model[face];
        const surface::Projector projector(model, {face});
        std::vector<Vec3> points, plain;
        std::vector<Vec2> uv;
        for (std::size_t t = 0; t < f.triangles.size(); ++t) {
            for (const Vec3& w : {Vec3(1, 1, 1), Vec3(9, 9, 1), Vec3(1, 9, 9), Vec3(9, 1, 9)}) {
                const Vec3 b = w / w.sum();
                points.push_back(b[0] * model.at(f.triangles[t][0]) + b[1] * model.at(f.triangles[t][1]) +
                                 b[2] * model.at(f.triangles[t][2]));
                uv.push_back(b[0] * f.uv[t][0] + b[1] * f.uv[t][1] + b[2] * f.uv[t][2]);
            }
        }
        plain = points;
        f.surface->project(plain, uv);
        projector.project(points);
        int kept = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            // Facets reach into the hole by the height of its arcs over their chords.
            if (shape.hole.distance(plain[i]) < shape.hole.radius) continue;
            ++kept;
            CHECK((points[i] - plain[i]).norm() < 1e-9);
        }
        CHECK(kept > static_cast<int>(points.size()) / 2);
    }
}
