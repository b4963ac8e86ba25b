// SPDX-License-Identifier: MIT
#include "support/measure_sources.h"
#include "support/plan_prism.h"
#include "support/random_sources.h"
#include "support/source_family.h"

#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/detail/face_sides.h>
#include <lacuna/surface/detail/round_sides.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/source_mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

struct Meshed {
    surface::Seeds seeds;
    surface::SourceMesh mesh;
    test::UnionQuality quality;
    double size = 0;
};

Meshed mesh_family_source(const test::FamilySource& source, double quads)
{
    Meshed result;
    double area = 0;
    for (const FaceId face : source.volume.faces(Role::source)) area += face_area(source.volume.model, face);
    result.size = std::sqrt(area / quads);
    const surface::SizeField size = [&](const Vec3&) { return result.size; };
    const auto links = surface::linking_surfaces(source.volume);
    result.seeds = surface::seed_source(source.volume, links, size, surface::QuadStyle::automatic,
                                        {.curvature = 0});
    result.mesh = surface::mesh_source(source.volume, links, result.seeds, {size, {}},
                                       [](const quads::PlanarRegion& region, const RunContext& context) {
                                           return quads::pave(region, {}, context).mesh;
                                       });
    result.quality = test::measure_union(result.mesh, result.size);
    return result;
}

} // namespace

TEST_CASE("quads of several source faces and of curved ones are good as one mesh in space")
{
    int meshes = 0;
    for (const test::FamilySource& source : test::source_family()) {
        for (const double quads : {40.0, 120.0, 400.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const test::UnionQuality q = mesh_family_source(source, quads).quality;
            CHECK(q.triangles == 0);
            CHECK(q.bad_sides == 0);
            CHECK(q.min_scaled_jacobian > 0.6);
            CHECK(q.mean_scaled_jacobian > 0.75);
            if (source.grid) CHECK(q.irregular == 0);
            CHECK(q.irregular <= 1.5 * source.least_irregular + 8);
            CHECK(q.irregular_shared == 0);
            ++meshes;
        }
    }
    MESSAGE(meshes << " meshes");
}

TEST_CASE(
    "boards whose cells are put together at random are meshed as one, flat or bent, with as many quads as "
    "asked where there is room")
{
    for (int number = 0; number < 15; ++number) {
        const test::FamilySource source = test::random_source(3, number);
        for (const double quads : {120.0, 400.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const test::UnionQuality q = mesh_family_source(source, quads).quality;
            CHECK(q.triangles == 0);
            CHECK(q.bad_sides == 0);
            CHECK(q.min_scaled_jacobian > (quads > 200 ? 0.5 : 0.2));
            CHECK(q.mean_scaled_jacobian > 0.85);
            CHECK(static_cast<double>(q.quads) >= 0.75 * quads);
            CHECK(static_cast<double>(q.quads) <= (quads > 200 ? 1.25 : 1.5) * quads);
        }
    }
}

TEST_CASE("several faces that are grids or rings get as many quads as asked for, within a quarter")
{
    int meshes = 0;
    for (const test::FamilySource& source : test::source_family()) {
        if (!source.grid) continue;
        for (const double quads : {120.0, 400.0, 1000.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const test::UnionQuality q = mesh_family_source(source, quads).quality;
            CHECK(static_cast<double>(q.quads) >= 0.75 * quads);
            CHECK(static_cast<double>(q.quads) <= 1.25 * quads);
            CHECK(test::UnionQuality::share(q.edges_of_size, q.edges) >= 0.85);
            ++meshes;
        }
    }
    MESSAGE(meshes << " meshes");
}

TEST_CASE("a face that bulges between its sides gets as many quads as its area asks for")
{
    for (const test::FamilySource& source : test::source_family()) {
        if (source.name != "sphere patch" && source.name != "sphere in halves") continue;
        for (const double quads : {120.0, 400.0, 1000.0, 3000.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const auto got = static_cast<double>(mesh_family_source(source, quads).quality.quads);
            CHECK(got >= 0.85 * quads);
            CHECK(got <= 1.15 * quads);
        }
    }
}

TEST_CASE("nodes of an edge that two source faces share are corners of quads of both")
{
    for (const test::FamilySource& source : test::source_family()) {
        CAPTURE(source.name);
        const Meshed made = mesh_family_source(source, 120);
        const Model& model = source.volume.model;
        std::map<EdgeId, std::set<FaceId>> users;
        for (const FaceId face : source.volume.faces(Role::source)) {
            for (const Loop& loop : model[face].loops) {
                for (const EdgeUse& use : loop.uses) users[use.edge].insert(face);
            }
        }
        for (const auto& [edge, faces] : users) {
            for (const FaceId face : faces) {
                std::set<Index> corners;
                for (std::size_t q = 0; q < made.mesh.quads.quads.size(); ++q) {
                    if (made.mesh.quads.face[q] != static_cast<Index>(face.index())) continue;
                    const Quad& quad = made.mesh.quads.quads[q];
                    corners.insert(quad.begin(), quad.end());
                }
                for (const Index node : made.mesh.on_edge.at(edge)) CHECK(corners.contains(node));
            }
        }
    }
}

TEST_CASE("free faces beside mapped ones get numbers of sides that a pattern has")
{
    // Quarters of a core need sides of which none is more than the others together, in an even number.
    for (const test::FamilySource& source : test::source_family()) {
        if (source.name != "core and ring in quarters" && source.name != "core and ring in halves") continue;
        for (const double quads : {40.0, 70.0, 120.0, 250.0, 400.0, 700.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const Meshed made = mesh_family_source(source, quads);
            // Halves are symmetric each, which may take three nodes on either side of an axis.
            CHECK(made.quality.irregular <= (source.name == "core and ring in halves" ? 12 : 8));
            CHECK(made.quality.min_scaled_jacobian > 0.7);
            const Model& model = source.volume.model;
            for (const FaceId face : source.volume.faces(Role::source)) {
                if (made.seeds.corners.contains(face)) continue;
                const std::vector<EdgeUse>& uses = model[face].loops[0].uses;
                int total = 0, most = 0;
                for (const EdgeUse& use : uses) {
                    const int count = made.seeds.count(use.edge);
                    total += count;
                    most = std::max(most, count);
                }
                CHECK(total % 2 == 0);
                if (uses.size() == 3) CHECK(2 * most < total);
            }
        }
    }
}

TEST_CASE(
    "lines over flat half and quarter rings stand nearly square to both sides, symmetric where those are")
{
    for (const test::FamilySource& source : test::source_family()) {
        if (!source.name.starts_with("flat ring")) continue;
        for (const double quads : {40.0, 120.0, 250.0, 400.0, 1000.0, 3000.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const Meshed made = mesh_family_source(source, quads);
            CHECK(made.quality.min_scaled_jacobian > 0.85);
            CHECK(made.quality.mean_scaled_jacobian > 0.95);
            std::size_t moved = 0;
            for (const auto& [edge, pieces] : made.seeds.pieces) {
                const std::vector<double> at = made.seeds.fractions(edge);
                const auto n = static_cast<double>(at.size() - 1);
                CHECK(at.size() - 1 == static_cast<std::size_t>(made.seeds.count(edge)));
                for (std::size_t i = 0; i + 1 < at.size(); ++i) {
                    CHECK(n * (at[i + 1] - at[i]) > 0.6);
                    CHECK(n * (at[i + 1] - at[i]) < 1.6);
                    // Half an ellipse is its own image in its other axis.
                    if (source.name.ends_with("halves"))
                        CHECK(at[i] + at[at.size() - 1 - i] == doctest::Approx(1).epsilon(1e-9));
                }
                for (const surface::SeedPiece& piece : pieces) moved += piece.placed.size();
            }
            CHECK(moved > 0);
        }
    }
}

TEST_CASE("nodes of mapped faces whose lines are square already stay evenly spread")
{
    for (const test::FamilySource& source : test::source_family()) {
        if (!source.grid || source.name == "trapezia in a row" || source.name.starts_with("saddle") ||
            source.name == "twisted")
            continue;
        CAPTURE(source.name);
        for (const auto& [edge, pieces] : mesh_family_source(source, 120).seeds.pieces) {
            for (const surface::SeedPiece& piece : pieces) CHECK(piece.placed.empty());
        }
    }
}

TEST_CASE("halves and quarters of a disc get rows along their round sides, and counts that do for both")
{
    for (const test::FamilySource& source : test::source_family()) {
        if (source.name != "disc in quarters" && source.name != "disc in halves") continue;
        for (const double quads : {120.0, 400.0, 1000.0}) {
            CAPTURE(source.name);
            CAPTURE(quads);
            const Meshed made = mesh_family_source(source, quads);
            const test::UnionQuality& q = made.quality;
            CHECK(test::UnionQuality::share(q.good_rows, q.rows) >= 0.95);
            CHECK(test::UnionQuality::share(q.good_shared_rows, q.shared_rows) >= 0.95);
            CHECK(q.irregular == 4);
            CHECK(q.irregular_shared == 0);
            CHECK(q.mean_scaled_jacobian > 0.96);
            CHECK(std::abs(static_cast<double>(q.quads) / quads - 1) < 0.25);
        }
    }
}

TEST_CASE("a side is round where it bulges outward, and not where it is bent inward")
{
    for (const test::FamilySource& source : test::source_family()) {
        const bool sector = source.name == "disc in quarters", half = source.name == "disc in halves",
                   holed = source.name == "holed plate in quarters";
        if (!sector && !half && !holed) continue;
        CAPTURE(source.name);
        const Model& model = source.volume.model;
        for (const FaceId face : source.volume.faces(Role::source)) {
            const auto sides = surface::sides_by_corners(model, face);
            const auto round = surface::bulge_of(model, face, sides, [](const Vec3&) { return 0.1; });
            REQUIRE(round.has_value() == !holed);
            if (!round) continue;
            CHECK(sides.size() == (sector ? 3 : 2));
            CHECK(round->radius == doctest::Approx(1).epsilon(0.01));
            CHECK(round->turn == doctest::Approx(std::acos(-1.0) / (sector ? 2 : 1)).epsilon(0.05));
        }
    }
}

namespace {

/// A ring in halves, `flat` times as wide one way as the other, that becomes round on the way to its target.
OpenVolume rounded_ring(double flat, double height)
{
    std::vector<test::PlanPatch> patches;
    for (int k = 0; k < 4; ++k) {
        const test::PlanMap part = [=](double s, double t) {
            const double angle = (k + t) * std::numbers::pi / 2, radius = 0.8 + 0.2 * s;
            return Vec2(radius * std::cos(angle), radius * std::sin(angle));
        };
        patches.push_back({k / 2, part, {0, 1 + k / 2, 0, 11 + k / 2}});
    }
    const test::SpaceMap map = [=](const Vec2& p, double h) {
        return Vec3(p.x(), (flat + h * (1 - flat)) * p.y(), height * h);
    };
    return test::prism_over(patches, map, 24);
}

} // namespace

TEST_CASE("lines over a flat ring that becomes round are square at both ends, where the way is long enough")
{
    for (const double flat : {0.4, 0.6}) {
        for (const double height : {0.2, 1.0, 8.0}) {
            for (const double quads : {40.0, 120.0, 400.0}) {
                CAPTURE(flat);
                CAPTURE(height);
                CAPTURE(quads);
                const test::FamilySource source{"", rounded_ring(flat, height)};
                const Meshed made = mesh_family_source(source, quads);
                if (made.seeds.corners.size() < 2) continue; // not mapped
                REQUIRE(made.mesh.links.size() == 2);
                const auto links = surface::linking_surfaces(source.volume);
                std::array<std::vector<double>, 2> angle; // of nodes on the target
                for (std::size_t l = 0; l < 2; ++l) {
                    const surface::LinkingNodes& nodes = made.mesh.links[l];
                    const surface::Chain &below = links[l].source, &above = links[l].target;
                    // No column leans by more than half a right angle against even ones.
                    for (std::size_t i = 0; i < nodes.source_at.size(); ++i) {
                        const double from = nodes.source_at[i] / below.length(),
                                     to = nodes.target_at[i] / above.length();
                        CHECK(std::abs(std::remainder(to - from, 1)) * above.length() < height);
                    }
                    for (const Vec3& p : above.points(nodes.target_at))
                        angle[l].push_back(std::atan2(p.y(), p.x()));
                }
                REQUIRE(angle[0].size() == angle[1].size());
                double most_off = 0;
                for (const double own : angle[0]) {
                    double off = 4;
                    for (const double other : angle[1])
                        off = std::min(off, std::abs(std::remainder(own - other, 2 * std::numbers::pi)));
                    most_off = std::max(most_off, off * double(angle[0].size()) / (2 * std::numbers::pi));
                }
                if (height < 8) continue;
                CHECK(made.quality.min_scaled_jacobian > 0.8);
                CHECK(made.quality.mean_scaled_jacobian > 0.95);
                CHECK(most_off < 0.3); // of a side
            }
        }
    }
}
