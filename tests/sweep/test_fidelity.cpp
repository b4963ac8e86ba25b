// SPDX-License-Identifier: MIT
#include "layers_of.h"
#include "support/check_valid.h"
#include "support/edit_model.h"
#include "support/whole_families.h"
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/fidelity.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::Fidelity;
using sweep::Misfit;
using sweep::SweepOptions;
using sweep::Swept;
using test::End;
using test::layers_of;
using test::PrismOptions;

namespace {

/// Faces of the model by the mesh's patches, as their groups name them.
std::vector<FaceId> faces_of(const OpenVolume& volume, const mesh::HexMesh& mesh)
{
    std::vector<FaceId> faces;
    for (const mesh::SkinPatch& patch : mesh.patches) {
        for (std::size_t f = 0; f < volume.model.faces.size(); ++f) {
            const std::string wall = "wall:" + std::to_string(volume.model.faces[f].tag);
            const std::string& name = volume.model.faces[f].name;
            const auto has = [&](const std::string& group) {
                return std::find(patch.groups.begin(), patch.groups.end(), group) != patch.groups.end();
            };
            if (has(wall) || (!name.empty() && has(name)) ||
                (volume.role[f] == Role::source && has("source")) ||
                (volume.role[f] == Role::target && has("target"))) {
                faces.emplace_back(f);
                break;
            }
        }
    }
    REQUIRE(faces.size() == mesh.patches.size());
    return faces;
}

Fidelity compared(const OpenVolume& volume, const mesh::HexMesh& mesh, double max_deviation = 0)
{
    return sweep::compare(volume, mesh, faces_of(volume, mesh), {}, quality::measure(mesh).volume,
                          {max_deviation});
}

std::vector<Misfit> misfits(const Fidelity& fidelity)
{
    std::vector<Misfit> found;
    for (const auto& face : fidelity.faces) {
        if (face.misfit != Misfit::none) found.push_back(face.misfit);
    }
    return found;
}

std::optional<Message> refusal(const OpenVolume& volume, const SweepOptions& options)
{
    try {
        sweep::sweep(volume, options);
    } catch (const NotSweepable& error) {
        CHECK(error.code() == "sweep.deviation");
        return error.message();
    }
    return std::nullopt;
}

/// A box with a square pocket in its target, whose walls and floor are target too.
OpenVolume box_with_pocket(double depth)
{
    healing::FacetSoup soup;
    std::vector<Role> role;
    const auto point = [&](double x, double y, double z) {
        soup.points.emplace_back(x, y, z);
        return static_cast<Index>(soup.points.size()) - 1;
    };
    const auto square = [&](double low, double high, double z) {
        return std::array<Index, 4>{point(low, low, z), point(high, low, z), point(high, high, z),
                                    point(low, high, z)};
    };
    int label = -1;
    const auto face = [&](Role r) {
        role.push_back(r);
        soup.label_name.push_back("f" + std::to_string(++label));
    };
    const auto add = [&](Index a, Index b, Index c, Index d) {
        soup.triangles.push_back({a, b, c});
        soup.triangles.push_back({a, c, d});
        soup.triangle_label.insert(soup.triangle_label.end(), 2, label);
    };
    const auto bottom = square(0, 2, 0), top = square(0, 2, 2), mouth = square(0.6, 1.4, 2),
               floor = square(0.6, 1.4, 2 - depth);
    face(Role::source);
    add(bottom[3], bottom[2], bottom[1], bottom[0]);
    for (std::size_t k = 0; k < 4; ++k) {
        face(Role::wall);
        add(bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]);
    }
    face(Role::target);
    for (std::size_t k = 0; k < 4; ++k) add(top[k], top[(k + 1) % 4], mouth[(k + 1) % 4], mouth[k]);
    for (std::size_t k = 0; k < 4; ++k) {
        face(Role::target);
        add(mouth[k], mouth[(k + 1) % 4], floor[(k + 1) % 4], floor[k]);
    }
    face(Role::target);
    add(floor[0], floor[1], floor[2], floor[3]);
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Role r = role[index(std::stoi(model.faces[f].name.substr(1)))];
        (r == Role::source ? roles.source : r == Role::target ? roles.target : roles.walls).emplace_back(f);
    }
    OpenVolume volume = open_volume(model, roles);
    volume = closure::close(volume, matching::match(volume)).volume;
    return volume;
}

RunContext on_threads(int count)
{
    RunContext context;
    context.threads = count;
    return context;
}

/// Largest and mean distance between a face and its quads, each place against all of the other skin.
struct Apart {
    double most = 0, mean = 0;
};

Apart apart_by_brute_force(const OpenVolume& volume, const mesh::HexMesh& mesh, FaceId face,
                           const std::vector<FaceId>& faces)
{
    using Corners = std::array<Vec3, 3>;
    struct Place {
        Vec3 point;
        double area;
    };
    std::vector<Corners> facets, quads;
    std::vector<Place> on_facets, on_quads;
    for (const Triangle& t : volume.model[face].triangles) {
        const Corners c{volume.model.at(t[0]), volume.model.at(t[1]), volume.model.at(t[2])};
        facets.push_back(c);
        const double area = (c[1] - c[0]).cross(c[2] - c[0]).norm() / 8;
        on_facets.push_back({(c[0] + c[1] + c[2]) / 3, area});
        for (std::size_t k = 0; k < 3; ++k) {
            on_facets.push_back({c[k], 0});
            on_facets.push_back({(c[k] + c[(k + 1) % 3]) / 2, area});
        }
    }
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::SkinQuad quad = mesh::skin_quad(mesh, i);
        if (faces[index(quad.patch)] != face) continue;
        std::array<Vec3, 4> c;
        for (std::size_t k = 0; k < 4; ++k) c[k] = mesh.nodes[index(quad.nodes[k])];
        const double area = (c[2] - c[0]).cross(c[3] - c[1]).norm() / 8;
        const Vec3 one = (c[0] + c[2]) / 2, other = (c[1] + c[3]) / 2, middle = (one + other) / 2;
        on_quads.push_back({middle, 2 * area});
        const bool flat = (one - other).norm() < 1e-3 * (c[2] - c[0]).norm();
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t next = (k + 1) % 4;
            on_quads.push_back({c[k], 0});
            // Of the two patches at a rim, the one that counts a middle is the mesh's own affair.
            if (quad.nodes[k] < quad.nodes[next]) on_quads.push_back({(c[k] + c[next]) / 2, area});
            if (!flat) quads.push_back({c[k], c[next], middle});
        }
        if (!flat) continue;
        quads.push_back({c[0], c[1], c[2]});
        quads.push_back({c[0], c[2], c[3]});
    }
    const auto one_way = [](const std::vector<Place>& places, const std::vector<Corners>& skin) {
        Apart found;
        double area = 0;
        for (const Place& place : places) {
            double least = std::numeric_limits<double>::infinity();
            for (const Corners& c : skin)
                least = std::min(least, geometry::closest_on_triangle(place.point, c).distance2);
            found.most = std::max(found.most, std::sqrt(least));
            found.mean += place.area * std::sqrt(least);
            area += place.area;
        }
        found.mean /= area;
        return found;
    };
    const Apart out = one_way(on_quads, facets), back = one_way(on_facets, quads);
    return {std::max(out.most, back.most), std::max(out.mean, back.mean)};
}

} // namespace

TEST_CASE("distances are those to the nearest of all facets and all quads, by any number of threads")
{
    int compared_faces = 0;
    test::MembersToRun run(5);
    for (const double bend : {0.0, 90.0}) {
        for (const double taper : {1.0, 0.5}) {
            for (const int cuts : {2, 8}) {
                for (const double size : {0.2, 0.5}) {
                    if (!run.next()) continue;
                    const auto volume = test::sealed({.sides = 0,
                                                      .height = 3,
                                                      .cuts = cuts,
                                                      .levels = 2 * cuts,
                                                      .taper = taper,
                                                      .bend = bend});
                    SweepOptions options = layers_of(size < 0.3 ? 16 : 6, size);
                    options.volume_share = 0;
                    options.max_deviation = 1;
                    const Swept swept = sweep::sweep(volume, options);
                    test::check_valid(swept.mesh);
                    const std::vector<FaceId> faces = faces_of(volume, swept.mesh);
                    const Fidelity one = sweep::compare(volume, swept.mesh, faces, {}, 1, {}, on_threads(1));
                    const Fidelity many = sweep::compare(volume, swept.mesh, faces, {}, 1, {}, on_threads(4));
                    for (std::size_t f = 0; f < one.faces.size(); ++f) {
                        CAPTURE(bend);
                        CAPTURE(taper);
                        CAPTURE(cuts);
                        CAPTURE(size);
                        CAPTURE(one.faces[f].tag);
                        CHECK(one.faces[f].max_distance == many.faces[f].max_distance);
                        CHECK(one.faces[f].mean_distance == many.faces[f].mean_distance);
                        CHECK(one.faces[f].place == many.faces[f].place);
                        if (one.faces[f].max_distance < 1e-9) continue; // flat
                        const Apart apart = apart_by_brute_force(volume, swept.mesh, FaceId(f), faces);
                        CHECK(one.faces[f].max_distance == doctest::Approx(apart.most).epsilon(1e-9));
                        // Never less; measured up to 0.07 % more. Of flat faces it is that in their plane.
                        const double mean = one.faces[f].mean_distance;
                        if (volume.role[f] == Role::wall) {
                            CHECK(mean > (1 - 1e-9) * apart.mean);
                            CHECK(mean < 1.002 * apart.mean);
                        }
                        ++compared_faces;
                    }
                }
            }
        }
    }
    MESSAGE(compared_faces << " curved faces");
}

TEST_CASE("the mesh of a straight-sided volume is the volume that was sealed, face by face")
{
    int combinations = 0;
    for (const int sides : {3, 4, 6}) {
        for (const int holes : {0, 1}) {
            for (const double taper : {1.0, 0.6}) {
                const auto volume = test::sealed({.sides = sides, .holes = holes, .taper = taper});
                const Swept swept = sweep::sweep(volume, layers_of(3, 0.3));
                test::check_valid(swept.mesh);
                const Fidelity& fidelity = swept.fidelity;
                CAPTURE(sides);
                CAPTURE(holes);
                CAPTURE(taper);
                CHECK(fidelity.volume == doctest::Approx(fidelity.sealed_volume).epsilon(1e-9));
                CHECK(fidelity.sealed_volume == doctest::Approx(closure::enclosed_volume(volume)));
                CHECK(fidelity.max_distance < 1e-9);
                CHECK(fidelity.faces.size() == volume.model.faces.size());
                for (const auto& face : fidelity.faces) CHECK(face.quads > 0);
                CHECK(swept.report.back().find("shape:") == 0);
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " volumes");
}

TEST_CASE("pipes, cones and elbows are off by the sag of their sides and no more, by default")
{
    int combinations = 0;
    test::MembersToRun run(4); // four of 15
    for (const double taper : {1.0, 0.5}) {
        for (const double bend : {0.0, 90.0}) {
            for (const int holes : {0, 1}) {
                // Round walls within each other may turn unlike each other, and fold the cells between.
                if ((bend > 0 || taper < 1) && holes > 0) continue;
                for (const int per_turn : {12, 16, 24}) {
                    if (!run.next()) continue;
                    const auto volume = test::sealed({.sides = 0,
                                                      .height = 5,
                                                      .holes = holes,
                                                      .hole_sides = 0,
                                                      .cuts = 8,
                                                      .levels = 32,
                                                      .taper = taper,
                                                      .bend = bend});
                    SweepOptions options = layers_of(12, 5);
                    options.curvature = per_turn;
                    options.volume_share = 0;
                    const Swept swept = sweep::sweep(volume, options);
                    test::check_valid(swept.mesh);
                    CAPTURE(taper);
                    CAPTURE(bend);
                    CAPTURE(per_turn);
                    CAPTURE(holes);
                    const double turn = std::numbers::pi / per_turn;
                    const double along = bend > 0 ? 5.0 * (bend / 12 * std::numbers::pi / 180) / 8 : 0;
                    CHECK(swept.fidelity.max_distance < 1.2 * (1 - std::cos(turn)) + along);
                    CHECK(swept.fidelity.max_distance > 0.5 * (1 - std::cos(turn)));
                    CHECK(swept.fidelity.mean_distance < swept.fidelity.max_distance);
                    const double lost = 1 - swept.fidelity.volume / swept.fidelity.sealed_volume;
                    CHECK(lost > 0);
                    CHECK(lost < 1.2 * (1 - std::sin(2 * turn) / (2 * turn)) + 0.02);
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " round volumes");
}

TEST_CASE("a mesh that cuts off much of the volume is refused, unless that is asked for")
{
    for (const double bend : {75.0, 80.0, 90.0}) {
        const auto volume = test::sealed({.sides = 0, .height = 5, .cuts = 4, .levels = 32, .bend = bend});
        SweepOptions options = layers_of(1, 0.3);
        options.volume_share = 0;
        CAPTURE(bend);
        try {
            sweep::sweep(volume, options);
            FAIL("one layer on a bend was taken");
        } catch (const NotSweepable& error) {
            CHECK(error.code() == "sweep.deviation");
        }
        options.max_deviation = 10;
        test::check_valid(sweep::sweep(volume, options).mesh);
    }
}

TEST_CASE("walls that are made lie where they were sealed, as given ones do, at any size")
{
    int combinations = 0;
    test::MembersToRun run(11); // three of 24
    for (const double bend : {40.0, 90.0, 170.0}) {
        for (const double twist : {0.0, 30.0}) {
            for (const int gone : {0, 1}) { // the outer wall, or the bore's
                PrismOptions shape{.sides = 0,
                                   .height = 4.5,
                                   .holes = 1,
                                   .hole_sides = 0,
                                   .cuts = 4,
                                   .levels = 32,
                                   .twist = twist,
                                   .bend = bend};
                shape.drop = [gone](const test::Part& part) {
                    return part.role == Role::wall && part.loop == gone;
                };
                const auto volume = test::sealed(shape);
                for (const double size : {0.25, 0.12}) {
                    if (!run.next()) continue;
                    const Swept swept = sweep::sweep(volume, layers_of(static_cast<int>(4.5 / size), size));
                    test::check_valid(swept.mesh);
                    CAPTURE(bend);
                    CAPTURE(twist);
                    CAPTURE(gone);
                    CAPTURE(size);
                    for (const sweep::FaceFidelity& face : swept.fidelity.faces)
                        CHECK(face.found <= face.allowed);
                    CHECK(swept.fidelity.volume ==
                          doctest::Approx(swept.fidelity.sealed_volume).epsilon(size * size));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " pipes with a wall missing");
}

TEST_CASE("quads given to the wrong face, a face left out, a fold and a node off its face are each found")
{
    const auto volume = test::sealed({.sides = 4, .height = 2, .pieces = 2});
    const Swept swept = sweep::sweep(volume, layers_of(4, 0.25));
    REQUIRE(misfits(compared(volume, swept.mesh)).empty());

    SUBCASE("one quad of a wall is its neighbour's, in the same plane")
    {
        mesh::HexMesh mesh = swept.mesh;
        const Index one = mesh.wall_patch.front();
        for (Index& patch : mesh.wall_patch) {
            if (patch == one) continue;
            mesh.wall_patch.front() = patch;
            break;
        }
        CHECK(misfits(compared(volume, mesh)).size() == 2);
    }
    SUBCASE("a wall's quads are all given to others")
    {
        mesh::HexMesh mesh = swept.mesh;
        const Index gone = mesh.wall_patch.front(), other = gone == 0 ? 1 : 0;
        std::replace(mesh.wall_patch.begin(), mesh.wall_patch.end(), gone, other);
        const Fidelity fidelity = compared(volume, mesh);
        const auto found = misfits(fidelity);
        CHECK(std::count(found.begin(), found.end(), Misfit::no_quads) == 1);
        const std::optional<Message> message = sweep::misfit(fidelity, mesh.layers);
        REQUIRE(message);
        CHECK(message->code() == "sweep.deviation");
        CHECK(message->entities().size() == 1);
    }
    SUBCASE("the skin folds over within its face")
    {
        mesh::HexMesh mesh = swept.mesh;
        std::vector<bool> rim(index(mesh.nodes_per_layer), false);
        for (const Segment& side : mesh.rim) rim[index(side[0])] = rim[index(side[1])] = true;
        const auto inside = static_cast<std::size_t>(std::find(rim.begin(), rim.end(), false) - rim.begin());
        REQUIRE(inside < rim.size());
        mesh.nodes[inside] = mesh.nodes[inside] * -0.9;
        const auto found = misfits(compared(volume, mesh));
        CHECK(found == std::vector{Misfit::folded});
    }
    SUBCASE("a node of a wall stands off it")
    {
        mesh::HexMesh mesh = swept.mesh;
        const auto node = index(mesh.rim.front()[0]) + index(mesh.nodes_per_layer);
        mesh.nodes[node] *= 1.3;
        CHECK(!misfits(compared(volume, mesh)).empty());
        CHECK(misfits(compared(volume, mesh, 10)).empty());
    }
}

TEST_CASE("the least deviation that is allowed depends on the model and the face, not on small quads")
{
    int members = 0;
    for (const int sides : {3, 4, 5, 6, 8}) {
        auto volume = test::sealed({.sides = sides, .height = 0.2});
        const Swept swept = sweep::sweep(volume, layers_of(10, 0.02));
        const auto node = index(swept.mesh.rim.front()[0]) + 5 * index(swept.mesh.nodes_per_layer);
        const Vec3 outward = Vec3(swept.mesh.nodes[node].x(), swept.mesh.nodes[node].y(), 0).normalized();
        const auto off_by = [&](double distance) {
            mesh::HexMesh mesh = swept.mesh;
            mesh.nodes[node] += distance * outward;
            return misfits(compared(volume, mesh)).size();
        };
        for (const double diagonal : {80.0, 1000.0}) {
            // Of the part that the volume is a small recess of.
            test::edit(volume.model,
                       [diagonal](topology::ModelBuilder& model) { model.diagonal = diagonal; });
            double least = 1e-4 * diagonal;
            for (const Face& face : volume.model.faces) {
                Eigen::AlignedBox3d box;
                for (const Triangle& t : face.triangles)
                    for (const Index p : t) box.extend(volume.model.at(p));
                least = std::min(least, 1e-2 * box.diagonal().norm());
            }
            CAPTURE(sides);
            CAPTURE(diagonal);
            for (const double share : {0.7, 0.95}) {
                REQUIRE(share * least > 0.25 * 0.02); // more than the quads allow
                CHECK(off_by(share * least) == 0);
                ++members;
            }
            CHECK(off_by(3 * least) > 0);
        }
    }
    CHECK(members == 20);
}

TEST_CASE("a pocket that is filled over is refused by the name of its faces, at any size")
{
    test::MembersToRun run(4); // each depth and each size once
    for (const double depth : {0.1, 0.2, 0.5}) {
        for (const double size : {0.4, 0.25, 0.1}) {
            if (!run.next()) continue;
            const auto volume = box_with_pocket(depth);
            CAPTURE(depth);
            CAPTURE(size);
            std::string why;
            std::optional<Swept> swept;
            try {
                swept = sweep::sweep(volume, layers_of(8, size));
            } catch (const NotSweepable& error) {
                why = error.what();
            }
            if (swept) { // or it is meshed as it is
                test::check_valid(swept->mesh);
                CHECK(swept->fidelity.volume == doctest::Approx(8 - 0.64 * depth).epsilon(1e-6));
            } else {
                CHECK(why.size() > 20);
            }
        }
    }
}

TEST_CASE("sizes and layers that refusals name lead to a mesh within a few steps")
{
    int tried = 0;
    test::MembersToRun run(3); // not a bend at the smaller deviation, which takes ten times as long
    for (const double bend : {0.0, 90.0}) {
        for (const double allowed : {0.005, 0.02}) {
            if (!run.next()) continue;
            const auto volume = test::sealed(
                {.sides = 0, .height = 5, .cuts = 4, .levels = 32, .bend = bend});
            SweepOptions options = layers_of(4, 0.6);
            options.max_deviation = allowed;
            options.volume_share = 0;
            std::optional<Message> why = refusal(volume, options);
            CHECK(why);
            for (int round = 0; why && round < 6; ++round) {
                CAPTURE(why->text());
                REQUIRE(why->needed().size() == 2); // the distance, and the size or the layers
                if (const auto* size = std::get_if<double>(&why->needed()[1]))
                    options.size = [even = *size](const Vec3&) { return even; };
                else
                    options.layers.count = static_cast<int>(std::get<long long>(why->needed()[1]));
                why = refusal(volume, options);
                ++tried;
            }
            CHECK_FALSE(why);
        }
    }
    MESSAGE(tried << " things tried");
}
