// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/edit_model.h"
#include "support/refusal.h"
#include "support/whole_families.h"
#include "surface/sealed.h"

#include <lacuna/quality/shared/second_order.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweepOptions;
using sweep::Swept;
using test::End;
using test::PrismOptions;
using test::without;

namespace {

SweepOptions second(double size, int curvature, int layers, bool serendipity)
{
    SweepOptions options;
    options.layers.count = layers;
    options.size = [size](const Vec3&) { return size; };
    options.curvature = curvature;
    options.volume_share = 0; // the sides asked for, whatever they lose
    options.order = 2;
    options.second_order.serendipity = serendipity;
    return options;
}

Swept swept_to_order(const OpenVolume& volume, const SweepOptions& options)
{
    Swept swept = sweep::sweep(volume, options);
    CHECK(swept.mesh.order() == options.order);
    test::check_valid(swept.mesh);
    return swept;
}

/// About the z axis.
class Cylinder final : public geometry::ExactSurface {
public:
    explicit Cylinder(double radius) : radius_(radius) {}
    void project(std::span<Vec3> points, std::span<Vec2> /*uv*/, const RunContext& /*context*/) const override
    {
        for (Vec3& p : points) p.head<2>() *= radius_ / p.head<2>().norm();
    }

private:
    double radius_;
};

class Circle final : public geometry::ExactCurve {
public:
    Circle(double radius, double height) : radius_(radius), height_(height) {}
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& /*context*/) const override
    {
        for (std::size_t i = 0; i < params.size(); ++i)
            points[i] = {radius_ * std::cos(params[i]), radius_ * std::sin(params[i]), height_};
    }

private:
    double radius_, height_;
};

/// Round walls and rims of a prism get the surfaces and curves they were faceted from.
OpenVolume exact(OpenVolume volume)
{
    ModelBuilder model(std::move(volume.model));
    for (Edge& edge : model.edges) {
        const Vec3& first = model.at(edge.points.front());
        const double radius = first.head<2>().norm();
        edge.curve = std::make_shared<Circle>(radius, first.z());
        double angle = std::atan2(first.y(), first.x());
        for (const Index p : edge.points) {
            const double next = std::atan2(model.at(p).y(), model.at(p).x());
            angle += std::remainder(next - angle, 2 * std::numbers::pi);
            edge.params.push_back(angle);
        }
    }
    for (const FaceId wall : volume.faces(Role::wall)) {
        Face& face = model[wall];
        face.surface = std::make_shared<Cylinder>(model.at(face.triangles[0][0]).head<2>().norm());
        face.uv.resize(face.triangles.size());
    }
    volume.model = std::move(model).finish();
    return volume;
}

double worst_off_radius(const mesh::HexMesh& mesh, double radius, double other)
{
    double worst = 0;
    for (std::size_t i = 2 * mesh.quads.size(); i < mesh.skin_count(); ++i)
        for (const Index n : mesh::skin_nodes(mesh, i)) {
            const double r = mesh.node(index(n)).head<2>().norm();
            worst = std::max(worst, std::min(std::abs(r - radius), std::abs(r - other)));
        }
    return worst;
}

} // namespace

TEST_CASE(
    "the volume of a cylinder is off by the fourth power of the size at order 2, by the second at order 1")
{
    for (const bool hole : {false, true}) {
        const OpenVolume volume = exact(
            test::sealed({.sides = 0, .radius = 1, .height = 1, .holes = hole ? 1 : 0, .hole_sides = 0}));
        double inner = hole ? 1 : 0;
        for (const Vec3& p : volume.model.points)
            if (hole) inner = std::min(inner, p.head<2>().norm());
        const double exact_volume = std::numbers::pi * (1 - inner * inner);
        for (const bool serendipity : {false, true}) {
            CAPTURE(hole);
            CAPTURE(serendipity);
            std::array<std::vector<double>, 2> errors;
            for (const int around : {8, 16, 32}) {
                for (const int order : {1, 2}) {
                    SweepOptions options = second(10, around, 2, serendipity);
                    options.order = order;
                    options.second_order.serendipity = serendipity && order == 2;
                    const Swept swept = swept_to_order(volume, options);
                    errors[static_cast<std::size_t>(order - 1)].push_back(
                        std::abs(swept.fidelity.volume / exact_volume - 1));
                }
            }
            for (std::size_t i = 0; i + 1 < 3; ++i) {
                CHECK(errors[0][i] / errors[0][i + 1] > 3);
                CHECK(errors[1][i] / errors[1][i + 1] > 10);
            }
            CHECK(errors[1][0] < errors[0][0] / 20);
        }
    }
}

TEST_CASE("middle nodes of exact walls and rims lie on them to rounding")
{
    const OpenVolume volume = exact(test::sealed({.sides = 0, .radius = 1, .height = 1}));
    for (const bool serendipity : {false, true}) {
        const Swept swept = swept_to_order(volume, second(10, 8, 2, serendipity));
        CHECK(worst_off_radius(swept.mesh, 1, 1) < 1e-12);
    }
}

TEST_CASE("a mesh with straight walls is the mesh of order 1 with nodes in the middles, to the bit")
{
    for (const bool serendipity : {false, true}) {
        const auto volume = test::sealed({.sides = 6, .holes = 1});
        SweepOptions options = second(0.3, 12, 3, serendipity);
        const Swept curved = swept_to_order(volume, options);
        options.order = 1;
        options.second_order = {};
        const Swept plain = swept_to_order(volume, options);
        CHECK(curved.mesh.nodes == plain.mesh.nodes);
        CHECK(curved.min_scaled_jacobian == plain.min_scaled_jacobian);
        for (std::size_t c = 0; c < curved.mesh.hex_count(); ++c)
            CHECK(quality::is_straight(quality::hex27_of(curved.mesh, c)));
    }
}

namespace {

/// Bent, barrelled, twisted and domed volumes with parts left out.
const std::vector<PrismOptions>& bent_family()
{
    static const std::vector<PrismOptions> family{
        {.sides = 4, .height = 3, .levels = 12, .bend = 90},
        {.sides = 0, .height = 2, .cuts = 4, .levels = 8, .belly = 1.4},
        {.sides = 0, .height = 2, .holes = 1, .hole_sides = 0, .cuts = 4, .levels = 8, .belly = 0.7},
        {.sides = 5, .levels = 8, .twist = 40},
        {.sides = 4, .cuts = 8, .target = End::bowed},
        {.sides = 4, .cuts = 8, .target = End::saddle},
        {.sides = 0, .cuts = 4, .target = End::tilted, .source = End::bowed},
        {.sides = 4, .height = 3, .levels = 12, .bend = 60, .drop = without(false, false, false, {1})},
        {.sides = 4, .height = 3, .levels = 12, .bend = 60, .drop = without(false, false, false, {0, 1})},
        {.sides = 0, .cuts = 4, .drop = without(false, false, true)},
        {.sides = 0, .cuts = 4, .drop = without(false, true, false)},
        {.sides = 6, .holes = 2, .hole_sides = 0, .cuts = 4, .taper = 0.7},
    };
    return family;
}

/// Calls `visit(volume, options)` for the family, few and more layers, hex27 and hex20.
template <class Visit>
void for_each_bent(const Visit& visit)
{
    test::MembersToRun run(5);
    for (std::size_t i = 0; i < bent_family().size(); ++i) {
        const OpenVolume volume = test::sealed(bent_family()[i]);
        for (const int layers : {1, 2, 5}) {
            for (const bool serendipity : {false, true}) {
                if (!run.next()) continue;
                CAPTURE(i);
                CAPTURE(layers);
                CAPTURE(serendipity);
                // Few layers on a long bend are coarse; what the skin may be off is not the matter here.
                SweepOptions options = second(0.5, 8, layers, serendipity);
                options.max_deviation = 1;
                visit(volume, options);
            }
        }
    }
}

} // namespace

TEST_CASE("bent, barrelled, twisted and domed volumes with parts left out are valid at order 2")
{
    for_each_bent([](const OpenVolume& volume, const SweepOptions& options) {
        CHECK(swept_to_order(volume, options).min_scaled_jacobian > 0.02);
    });
}

TEST_CASE("nodes of order 2 that are left to be made are those of a mesh that holds them, to the bit")
{
    int left_to_be_made = 0, number = 0;
    for_each_bent([&](const OpenVolume& volume, SweepOptions options) {
        const Swept held = sweep::sweep(volume, options);
        options.layered = true;
        RunContext context;
        context.threads = 1 + number++ % 3;
        Swept swept = sweep::sweep(volume, options, context);
        mesh::HexMesh made = swept.mesh;
        if (swept.layers) {
            ++left_to_be_made;
            CHECK(swept.mesh.middles.nodes.empty());
            const mesh::LayeredMesh layered{swept.mesh, *swept.layers};
            const mesh::HexMesh all = mesh::make_layers(layered, 0, made.layers, {}, context);
            made.nodes = all.nodes;
            made.middles.nodes = all.middles.nodes;
            // A layer alone is what it is among all.
            const mesh::MiddlePlaces places(made);
            for (int layer = 0; layer < made.layers; ++layer) {
                const mesh::HexMesh one = mesh::make_layers(layered, layer, layer + 1);
                const std::size_t first = places.side(index(layer), 0);
                CHECK(std::equal(one.middles.nodes.begin(), one.middles.nodes.end(),
                                 made.middles.nodes.begin() + static_cast<std::ptrdiff_t>(first)));
            }
            for (std::size_t i = 0; i < made.skin_count(); ++i)
                for (const Index node : mesh::skin_nodes(made, i))
                    CHECK(swept.layers->on_skin(node) == made.node(index(node)));
        }
        test::check_valid(made);
        CHECK(made.nodes == held.mesh.nodes);
        CHECK(made.middles.nodes == held.mesh.middles.nodes);
        CHECK(swept.min_scaled_jacobian == held.min_scaled_jacobian);
        CHECK(swept.fidelity.max_distance == held.fidelity.max_distance);
    });
    CHECK(left_to_be_made > number / 2);
}

TEST_CASE("a mesh of order 2 is the same, to the bit, for any number of threads")
{
    const auto volume = test::sealed({.sides = 4, .height = 3, .cuts = 4, .levels = 12, .bend = 70});
    std::vector<Vec3> nodes;
    for (const int threads : {1, 2, 5}) {
        RunContext context;
        context.threads = threads;
        const Swept swept = sweep::sweep(volume, second(0.3, 8, 4, false), context);
        if (nodes.empty()) nodes = swept.mesh.middles.nodes;
        CHECK(swept.mesh.middles.nodes == nodes);
    }
}

namespace {

/// A box whose nodes came with it and stay.
OpenVolume given_box()
{
    OpenVolume volume = test::sealed({.sides = 4, .cuts = 3, .levels = 3});
    test::edit(volume.model, [](ModelBuilder& model) {
        for (Face& face : model.faces) face.keeps_nodes = true;
    });
    return volume;
}

Vec3 none() { return Vec3::Constant(std::numeric_limits<double>::quiet_NaN()); }

} // namespace

TEST_CASE("given middle nodes stay bit for bit, and one that turns a cell over is refused by its face")
{
    OpenVolume volume = given_box();
    SweepOptions options = second(0.5, 8, 3, true);
    const auto moved = [](double by) {
        return [by](std::span<const Vec3> from, std::span<const Vec3> to) {
            std::vector<Vec3> middles;
            for (std::size_t i = 0; i < from.size(); ++i) {
                const Vec3 middle = (from[i] + to[i]) / 2;
                middles.push_back(middle + by * (to[i] - from[i]).norm() * Vec3(0.3, 0.7, 0.5));
            }
            return middles;
        };
    };
    options.second_order.given = moved(0.05);
    const Swept swept = swept_to_order(volume, options);
    for (std::size_t i = 0; i < swept.mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = mesh::skin_nodes(swept.mesh, i);
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 &a = swept.mesh.nodes[index(nodes.node[k])],
                       &b = swept.mesh.nodes[index(nodes.node[(k + 1) % 4])];
            const bool rising = nodes.node[k] < nodes.node[(k + 1) % 4];
            const std::array<Vec3, 1> from{rising ? a : b}, to{rising ? b : a};
            CHECK(swept.mesh.node(index(nodes.node[4 + k])) == moved(0.05)(from, to)[0]);
        }
    }
    options.second_order.given = [](std::span<const Vec3> from, std::span<const Vec3> to) {
        std::vector<Vec3> middles(from.size(), none());
        middles[0] = from[0] + 0.1 * (to[0] - from[0]);
        return middles;
    };
    CHECK(test::refusal([&] { sweep::sweep(volume, options); }, {"order 2", "face", "size of"}) ==
          "sweep.second_order");
}

TEST_CASE("where given middle nodes turn cells over the mesh is refused, by its face")
{
    const OpenVolume volume = given_box();
    SweepOptions options = second(0.4, 8, 6, true);
    options.max_deviation = 10; // the given nodes are not on the faces
    int refused = 0, plain = 0;
    test::MembersToRun run(9); // five of 40, each step once
    for (unsigned seed = 0; seed < 8; ++seed) {
        for (const double by : {0.1, 0.2, 0.25, 0.3, 0.4}) {
            if (!run.next()) continue;
            CAPTURE(seed);
            CAPTURE(by);
            options.second_order.given = [&](std::span<const Vec3> from, std::span<const Vec3> to) {
                std::mt19937 dice(seed);
                std::uniform_real_distribution<double> step(-1, 1);
                std::vector<Vec3> middles;
                for (std::size_t i = 0; i < from.size(); ++i) {
                    const Vec3 way(step(dice), step(dice), step(dice));
                    const double share = i % 7 == 0 ? by : 0;
                    middles.push_back((from[i] + to[i]) / 2 +
                                      share * (to[i] - from[i]).norm() * way.normalized());
                }
                return middles;
            };
            const std::string code = test::refusal([&] { swept_to_order(volume, options); });
            CHECK((code == "done" || code == "sweep.second_order"));
            SweepOptions layered = options;
            layered.layered = true;
            CHECK(test::refusal([&] { CHECK(sweep::sweep(volume, layered).layers.has_value()); }) == code);
            ++(code != "done" ? refused : plain);
        }
    }
    CHECK(refused > 0);
    CHECK(plain > 0);
    MESSAGE("plain " << plain << ", refused " << refused);
}
