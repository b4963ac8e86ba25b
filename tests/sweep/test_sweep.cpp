// SPDX-License-Identifier: MIT
#include "layers_of.h"
#include "support/check_valid.h"
#include "support/edit_model.h"
#include "support/quad_meshers.h"
#include "support/whole_families.h"
#include "surface/sealed.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweepOptions;
using sweep::Swept;
using test::End;
using test::layers_of;
using test::Part;
using test::PrismOptions;
using test::without;

namespace {

/// Layers, and a size near the one wanted that gives every edge of the source an even number of sides, as the
/// test's mesher needs.
SweepOptions layers_of(int count, double size, const OpenVolume& volume)
{
    SweepOptions options = test::layers_of(count, size);
    std::vector<std::pair<std::vector<Vec3>, double>> edges;
    for (const FaceId face : volume.faces(Role::source)) {
        for (const Loop& loop : volume.model[face].loops) {
            for (const EdgeUse& use : loop.uses) {
                auto& [line, side] = edges.emplace_back();
                for (const Index p : volume.model[use.edge].points) line.push_back(volume.model.at(p));
                const double length = edge_length(volume.model, use.edge);
                side = length / (2 * std::max(1.0, std::round(length / size / 2)));
            }
        }
    }
    options.size = [edges](const Vec3& p) {
        double least = 1e300, side = 0;
        for (const auto& [line, own] : edges) {
            for (std::size_t i = 0; i + 1 < line.size(); ++i) {
                const Vec3 d = line[i + 1] - line[i];
                const double f = std::clamp((p - line[i]).dot(d) / d.squaredNorm(), 0.0, 1.0);
                const double distance = (p - line[i] - f * d).norm();
                if (distance < least) {
                    least = distance;
                    side = own;
                }
            }
        }
        return side;
    };
    return options;
}

double volume_of(const mesh::HexMesh& mesh) { return quality::measure(mesh).volume; }

std::set<std::string> groups_of(const mesh::HexMesh& mesh)
{
    std::set<std::string> names;
    for (const auto& patch : mesh.patches) names.insert(patch.groups.begin(), patch.groups.end());
    return names;
}

/// A mesh of the volume: checked, its cells counted, its volume that of the facets.
Swept check_swept(const OpenVolume& volume, const SweepOptions& options, double closeness)
{
    const Swept swept = sweep::sweep(volume, options);
    test::check_valid(swept.mesh);
    CHECK(swept.mesh.hex_count() == swept.mesh.quads.size() * static_cast<std::size_t>(swept.mesh.layers));
    CHECK(swept.mesh.nodes.size() == static_cast<std::size_t>(swept.mesh.nodes_per_layer) *
                                         static_cast<std::size_t>(swept.mesh.layers + 1));
    CHECK(volume_of(swept.mesh) == doctest::Approx(closure::enclosed_volume(volume)).epsilon(closeness));
    CHECK(!swept.report.empty());
    return swept;
}

std::string refusal_of(const std::function<void()>& work)
{
    try {
        work();
    } catch (const Error& error) {
        CHECK(std::string(error.what()).size() > 20);
        return error.code();
    }
    return "done";
}

bool same_bits(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)) == 0;
}

/// A unit box whose target goes on down one side to a height: there its rim and the walls' edges lie in one
/// line.
OpenVolume box_with_bent_target(double height)
{
    healing::FacetSoup soup;
    const double h = height;
    soup.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1},
                   {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {1, 1, h}, {0, 1, h}};
    const std::vector<std::vector<Triangle>> faces{{{0, 3, 2}, {0, 2, 1}},
                                                   {{0, 1, 5}, {0, 5, 4}},
                                                   {{1, 2, 8}, {1, 8, 5}, {5, 8, 6}},
                                                   {{2, 3, 9}, {2, 9, 8}},
                                                   {{3, 0, 9}, {0, 4, 9}, {4, 7, 9}},
                                                   {{4, 5, 6}, {4, 6, 7}, {8, 9, 7}, {8, 7, 6}}};
    for (std::size_t f = 0; f < faces.size(); ++f) {
        soup.label_name.push_back("f" + std::to_string(f));
        for (const Triangle& t : faces[f]) {
            soup.triangles.push_back(t);
            soup.triangle_label.push_back(static_cast<int>(f));
        }
    }
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        (name == "f0" ? roles.source : name == "f5" ? roles.target : roles.walls).emplace_back(f);
    }
    OpenVolume volume = open_volume(model, roles);
    volume = closure::close(volume, matching::match(volume)).volume;
    return volume;
}

} // namespace

TEST_CASE("every class of prism becomes hexahedra: source quads times layers, proved, of the volume's size")
{
    int combinations = 0;
    test::MembersToRun run(5);
    const std::vector<std::pair<const char*, std::function<bool(const Part&)>>> drops{
        {"closed", nullptr},
        {"I", without(false, false, true)},
        {"II", without(false, false, false, {0, 1})},
        {"III", without(false, false, false, {0})},
        {"IV", without(false, true, false)},
        {"IV turned", without(true, false, false)},
        {"V", without(true, true, false)},
    };
    for (const auto& [name, drop] : drops) {
        for (const int sides : {3, 4, 6}) {
            for (const int holes : {0, 1, 4}) {
                for (const int layers : {1, 3}) {
                    for (const double taper : {1.0, 0.6}) {
                        if (!run.next()) continue;
                        const PrismOptions options{
                            .sides = sides, .holes = holes, .taper = taper, .drop = drop};
                        CAPTURE(name);
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(layers);
                        CAPTURE(taper);
                        const auto volume = test::sealed(options);
                        const Swept swept = check_swept(
                            volume, layers_of(layers, holes == 4 ? 0.06 : 0.2, volume), 1e-6);
                        CHECK(swept.mesh.layers == layers);
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " prisms");
}

TEST_CASE("curved, twisted and bent volumes of every class become hexahedra")
{
    int combinations = 0;
    int number = 0;
    test::MembersToRun run(5);
    for (const auto& drop : std::vector<std::function<bool(const Part&)>>{
             nullptr, without(false, false, true), without(false, false, false, {0}),
             without(false, false, false, {0, 1}), without(false, true, false), without(true, true, false)}) {
        ++number;
        for (const int sides : {0, 4, 5}) {
            for (const int holes : {0, 1}) {
                for (const double twist : {0.0, 20.0}) {
                    for (const double bend : {0.0, 60.0}) {
                        for (const End end : {End::planar, End::tilted}) {
                            if (!run.next()) continue;
                            const PrismOptions options{.sides = sides,
                                                       .height = 4,
                                                       .holes = holes,
                                                       .cuts = 4,
                                                       .levels = 8,
                                                       .twist = twist,
                                                       .bend = bend,
                                                       .target = end,
                                                       .drop = drop};
                            CAPTURE(sides);
                            CAPTURE(holes);
                            CAPTURE(twist);
                            CAPTURE(bend);
                            CAPTURE(static_cast<int>(end));
                            CAPTURE(number);
                            const auto volume = test::sealed(options);
                            check_swept(volume, layers_of(6, 0.15, volume), 0.05);
                            ++combinations;
                        }
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " curved volumes");
}

TEST_CASE("bends with any of their walls missing are filled well, left to themselves and told to follow")
{
    int combinations = 0;
    test::MembersToRun run(5);
    for (const double bend : {40.0, 90.0, 150.0}) {
        for (const double taper : {1.0, 0.6}) {
            for (const auto& gone :
                 std::vector<std::vector<int>>{{0, 1, 2}, {1, 2, 3}, {1, 2}, {0, 3}, {0, 2}, {1}}) {
                for (const auto shape : {closure::EdgeShape::automatic, closure::EdgeShape::follow}) {
                    for (const End end : {End::planar, End::bowed}) {
                        if (!run.next()) continue;
                        const PrismOptions options{.sides = 4,
                                                   .height = 4,
                                                   .cuts = 4,
                                                   .levels = 12,
                                                   .twist = 20,
                                                   .taper = taper,
                                                   .bend = bend,
                                                   .target = end,
                                                   .drop = without(false, false, false, gone)};
                        CAPTURE(bend);
                        CAPTURE(taper);
                        CAPTURE(gone.size());
                        CAPTURE(gone.front());
                        CAPTURE(static_cast<int>(end));
                        const auto volume = test::sealed(options, {shape});
                        const Swept swept = check_swept(volume, layers_of(12, 0.3), 0.05);
                        CHECK(quality::measure(swept.mesh).min_scaled_jacobian > 0.2);
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " bends");
}

TEST_CASE("stacked walls and walls in rows become hexahedra, rows to rings")
{
    int combinations = 0;
    for (const int sides : {0, 4, 5}) {
        for (const int rows : {1, 3}) {
            for (const int pieces : {1, 2}) {
                for (const int layers : {4, 9}) {
                    const auto volume = test::sealed({.sides = sides,
                                                      .height = 3,
                                                      .cuts = 2,
                                                      .rows = rows,
                                                      .pieces = pieces,
                                                      .taper = 0.8});
                    CAPTURE(sides);
                    CAPTURE(rows);
                    CAPTURE(pieces);
                    const Swept swept = check_swept(volume, layers_of(layers, 0.25, volume), 0.01);
                    std::size_t walls = 0;
                    for (const std::string& name : groups_of(swept.mesh))
                        walls += name.rfind("wall:", 0) == 0 ? 1 : 0;
                    CHECK(walls == volume.faces(Role::wall).size());
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " stacks and rows");
}

TEST_CASE("boards of source faces are meshed face by face, each its own group")
{
    for (const auto& [n, m] : std::vector<std::pair<int, int>>{{1, 2}, {3, 3}, {4, 2}}) {
        for (const bool hole : {false, true}) {
            if (hole && (n < 3 || m < 3)) continue;
            const auto volume = test::board_box(n, m, 2,
                                                [&](int i, int j) { return hole && i == 1 && j == 1; });
            const Swept swept = check_swept(volume, layers_of(2, 0.4), 1e-9);
            std::set<Index> patches(swept.mesh.source_patch.begin(), swept.mesh.source_patch.end());
            CHECK(patches.size() == volume.faces(Role::source).size());
        }
    }
}

TEST_CASE("layers lie at the heights asked for on every wall, whatever the spacing")
{
    using sweep::Spacing;
    int combinations = 0;
    for (const int sides : {0, 4, 6}) {
        for (const bool missing : {false, true}) {
            const auto volume = test::sealed(
                {.sides = sides, .height = 3, .holes = 1, .drop = without(false, false, missing)});
            for (const Spacing spacing : {Spacing::geometric, Spacing::bell, Spacing::both_ends}) {
                for (const double bias : {0.2, 1.0, 5.0}) {
                    SweepOptions options = layers_of(5, 0.3, volume);
                    options.layers.bias = bias;
                    options.layers.spacing = spacing;
                    const auto heights = sweep::layer_heights(options.layers);
                    const Swept swept = check_swept(volume, options, 0.02);
                    double worst = 0;
                    for (std::size_t i = 0; i < swept.mesh.nodes.size(); ++i) {
                        const std::size_t layer = i / static_cast<std::size_t>(swept.mesh.nodes_per_layer);
                        worst = std::max(worst, std::abs(swept.mesh.nodes[i].z() - 3 * heights[layer]));
                    }
                    CHECK(worst < 1e-6);
                    ++combinations;
                }
            }
            SweepOptions given = layers_of(0, 0.3, volume);
            given.layers.heights = {0.1, 0.15, 0.7, 1};
            const Swept swept = check_swept(volume, given, 0.02);
            CHECK(swept.mesh.layers == 4);
            CHECK(swept.mesh.nodes[static_cast<std::size_t>(swept.mesh.nodes_per_layer) * 3].z() ==
                  doctest::Approx(2.1));
        }
    }
    MESSAGE(combinations << " spacings");
}

TEST_CASE("a class IV volume turned round keeps heights and names of its ends")
{
    const auto turned = test::sealed({.sides = 4, .height = 3, .drop = without(true, false, false)});
    REQUIRE(turned.turned_round);
    SweepOptions options = layers_of(0, 0.5);
    options.layers.heights = {0.1, 1};
    const Swept swept = check_swept(turned, options, 1e-9);
    // The thin layer is at the source, which is void and lies at z = 0.
    std::set<double> heights;
    for (const Vec3& p : swept.mesh.nodes) heights.insert(std::round(p.z() * 1e6) / 1e6);
    CHECK(heights == std::set<double>{0, 0.3, 3});
    for (std::size_t i = 0; i < swept.mesh.skin_count(); ++i) {
        const auto quad = mesh::skin_quad(swept.mesh, i);
        const auto& groups = swept.mesh.patches[static_cast<std::size_t>(quad.patch)].groups;
        double z = 0;
        for (const Index n : quad.nodes) z += swept.mesh.nodes[static_cast<std::size_t>(n)].z() / 4;
        if (std::find(groups.begin(), groups.end(), "source") != groups.end()) CHECK(z == doctest::Approx(0));
        if (std::find(groups.begin(), groups.end(), "target") != groups.end()) CHECK(z == doctest::Approx(3));
    }
    CHECK(groups_of(swept.mesh).contains("source"));
    CHECK(groups_of(swept.mesh).contains("target"));
}

TEST_CASE("groups are named by role and tag, void faces as void, and the names of the input are kept")
{
    auto prism = test::prism({.sides = 4, .drop = without(false, false, false, {0, 1})});
    test::edit(prism.model, [&](ModelBuilder& model) { model[prism.roles.walls[0]].name = "my wall"; });
    auto volume = prism.open();
    volume = closure::close(volume, matching::match(volume)).volume;
    const Swept swept = check_swept(volume, layers_of(2, 0.5), 1e-9);
    const auto names = groups_of(swept.mesh);
    for (const char* name : {"source", "target", "void:1", "void:2", "my wall"}) {
        CAPTURE(name);
        CHECK(names.contains(name));
    }
    for (const FaceId wall : prism.roles.walls)
        CHECK(names.contains("wall:" + std::to_string(prism.model[wall].tag)));
    CHECK(swept.mesh.volume_groups == std::vector<std::string>{"volume"});
    std::set<int> tags;
    for (const auto& patch : swept.mesh.patches) {
        CHECK(patch.tag > 0);
        CHECK(tags.insert(patch.tag).second);
    }
    // Each patch lies where its face does.
    for (std::size_t i = 0; i < swept.mesh.skin_count(); ++i) {
        const auto quad = mesh::skin_quad(swept.mesh, i);
        const auto& groups = swept.mesh.patches[static_cast<std::size_t>(quad.patch)].groups;
        double low = 1e300, high = -1e300;
        for (const Index n : quad.nodes) {
            low = std::min(low, swept.mesh.nodes[static_cast<std::size_t>(n)].z());
            high = std::max(high, swept.mesh.nodes[static_cast<std::size_t>(n)].z());
        }
        if (std::ranges::find(groups, "source") != groups.end())
            CHECK(high == doctest::Approx(0));
        else if (std::ranges::find(groups, "target") != groups.end())
            CHECK(low == doctest::Approx(2));
        else
            CHECK(high - low == doctest::Approx(1));
    }
}

TEST_CASE("source and target swapped give a mesh as good")
{
    int combinations = 0;
    for (const auto& drop : std::vector<std::function<bool(const Part&)>>{
             nullptr, without(false, false, true), without(false, false, false, {0, 1})}) {
        for (const double taper : {1.0, 0.7}) {
            for (const double bend : {0.0, 40.0}) {
                const auto prism = test::prism({.sides = 4,
                                                .height = 4,
                                                .cuts = 3,
                                                .levels = 8,
                                                .twist = 10,
                                                .taper = taper,
                                                .bend = bend,
                                                .drop = drop});
                std::array<double, 2> worst{}, mean{};
                for (const bool swapped : {false, true}) {
                    Roles roles = prism.roles;
                    if (swapped) std::swap(roles.source, roles.target);
                    auto volume = open_volume(prism.model, roles);
                    volume = closure::close(volume, matching::match(volume)).volume;
                    SweepOptions options = layers_of(6, 0.3);
                    // As many sides both ways, whichever end they are counted on.
                    options.size = [&](const Vec3&) { return (swapped ? taper : 1.0) * std::sqrt(2.0) / 5; };
                    const Swept swept = check_swept(volume, options, 0.05);
                    CHECK(swept.mesh.quads.size() == 25);
                    const auto quality = quality::measure(swept.mesh);
                    worst[swapped] = quality.min_scaled_jacobian;
                    mean[swapped] = quality.mean_scaled_jacobian;
                }
                CAPTURE(taper);
                CAPTURE(bend);
                CHECK(worst[0] == doctest::Approx(worst[1]).epsilon(0.02));
                CHECK(mean[0] == doctest::Approx(mean[1]).epsilon(0.01));
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " swaps");
}

TEST_CASE("the mesh is the same to the bit for any number of threads, and from run to run")
{
    for (const auto& options : std::vector<PrismOptions>{
             {.sides = 5, .height = 4, .holes = 2, .cuts = 3, .levels = 8, .twist = 15, .bend = 40},
             {.sides = 0, .height = 3, .holes = 1, .hole_sides = 0, .rows = 2, .taper = 0.7},
             {.sides = 4,
             .height = 3,
             .levels = 4,
             .target = End::bowed,
             .drop = without(false, false, false, {0, 1})}}) {
        const auto volume = test::sealed(options);
        std::optional<Swept> first;
        for (const int threads : {1, 2, 5, 1}) {
            RunContext context;
            context.threads = threads;
            const Swept swept = sweep::sweep(volume, layers_of(7, 0.12, volume), context);
            if (!first) {
                first = swept;
                continue;
            }
            CHECK(same_bits(first->mesh.nodes, swept.mesh.nodes));
            CHECK(first->mesh.quads == swept.mesh.quads);
            CHECK(first->report == swept.report);
        }
    }
}

TEST_CASE("an affine map of the volume maps the mesh")
{
    const PrismOptions options{
        .sides = 4, .height = 2, .cuts = 2, .taper = 0.8, .drop = without(false, false, false, {0, 1})};
    Eigen::Matrix3d linear;
    linear << 1.2, 0.3, 0.1, -0.2, 0.9, 0.2, 0.1, -0.1, 1.5;
    const auto map = [&](const Vec3& p) { return Vec3(linear * p + Vec3(3, 4, 5)); };
    const auto prism = test::prism(options);
    std::array<Swept, 2> swept;
    for (const bool moved : {false, true}) {
        auto volume = open_volume(moved ? test::moved(prism.model, map) : prism.model, prism.roles);
        volume = closure::close(volume, matching::match(volume)).volume;
        SweepOptions sizes = layers_of(4, 10);
        sizes.size = [&](const Vec3& p) { return moved ? 1e6 : 1e6 + p.x(); };
        swept[moved] = check_swept(volume, sizes, 1e-9);
    }
    REQUIRE(swept[0].mesh.nodes.size() == swept[1].mesh.nodes.size());
    double worst = 0;
    for (std::size_t i = 0; i < swept[0].mesh.nodes.size(); ++i)
        worst = std::max(worst, (map(swept[0].mesh.nodes[i]) - swept[1].mesh.nodes[i]).norm());
    CHECK(worst < 1e-9);
}

TEST_CASE("rim nodes of both ends, and the walls' own corners, are points of the volume")
{
    const auto volume = test::sealed({.sides = 6, .height = 2, .holes = 1, .taper = 0.8});
    const Swept swept = check_swept(volume, layers_of(3, 0.3, volume), 1e-6);
    for (const Vertex& vertex : volume.model.vertices) {
        const Vec3& p = volume.model.at(vertex.point);
        CHECK(std::find(swept.mesh.nodes.begin(), swept.mesh.nodes.end(), p) != swept.mesh.nodes.end());
    }
}

TEST_CASE("bad options are refused")
{
    const auto volume = test::sealed({.sides = 4});
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    for (const int count : {-1, -7})
        CHECK(refusal_of([&] { sweep::sweep(volume, layers_of(count, 0.3)); }) == "sweep.layers");
    for (const double size : {0.0, -1.0, nan, infinity})
        CHECK(refusal_of([&] { sweep::sweep(volume, layers_of(2, size)); }) == "sweep.size");
    for (const double bias : {0.0, -2.0, nan, infinity}) {
        SweepOptions options = layers_of(3, 0.3);
        options.layers.bias = bias;
        CHECK(refusal_of([&] { sweep::sweep(volume, options); }) != "done");
    }
    SweepOptions strict = layers_of(2, 0.3);
    strict.min_scaled_jacobian = 0.999;
    CHECK(refusal_of([&] {
              sweep::sweep(test::sealed({.sides = 4, .twist = 30}), strict);
          }).rfind("quality.", 0) == 0);
    SweepOptions no_mesher = layers_of(2, 0.3);
    no_mesher.quads = sweep::Quads::gmsh;
    CHECK(refusal_of([&] { sweep::sweep(test::sealed({.sides = 5}), no_mesher); }) == "surface.no_mesher");
    SweepOptions mapped = layers_of(2, 0.3);
    mapped.quads = sweep::Quads::mapped;
    CHECK(refusal_of([&] { sweep::sweep(test::sealed({.sides = 5}), mapped); }) == "surface.not_four_sided");
    CHECK(refusal_of([&] {
              sweep::sweep(test::prism({.drop = without(false, false, true)}).open(), layers_of(2, 0.3));
          }) == "sweep.not_closed");
    // So fine that the counts would not fit.
    CHECK(refusal_of([&] { sweep::sweep(volume, layers_of(2, 1e-300)); }) != "done");
}

TEST_CASE("every option out of range is refused by name, before and by the sweep")
{
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();
    const auto size = [](const Vec3&) { return 0.5; };
    struct Wrong {
        std::string code;
        std::function<void(SweepOptions&)> set;
    };
    std::vector<Wrong> wrongs{
        {"sweep.layers", [](SweepOptions& o) { o.layers.count = -1; }},
        {"sweep.layer_heights",
         [](SweepOptions& o) {
             o.layers.heights = {0.5, 1};
         }}, // and a count of 3
        {"sweep.bias", [](SweepOptions& o) { o.layers.bias = 0; }},
        {"sweep.rows", [](SweepOptions& o) { o.rows = -1; }},
        {"sweep.rows", [&](SweepOptions& o) { o.row_height = size; }},
    };
    for (const double least : {nan, 1.5, -0.1}) {
        wrongs.push_back(
            {"sweep.min_scaled_jacobian", [least](SweepOptions& o) { o.min_scaled_jacobian = least; }});
    }
    for (const sweep::Quads quads : {sweep::Quads::mapped, sweep::Quads::gmsh, sweep::Quads::keep}) {
        wrongs.push_back({"sweep.rows", [=](SweepOptions& o) {
                              o.quads = quads;
                              o.rows = 2;
                          }});
    }
    for (const double value : {nan, -2.0, 2.0}) {
        wrongs.push_back({"sweep.improve", [value](SweepOptions& o) { o.improving.good_enough = value; }});
    }
    for (const double value : {nan, -1.0}) {
        wrongs.push_back({"sweep.improve", [value](SweepOptions& o) { o.improving.work = value; }});
        wrongs.push_back({"sweep.improve", [value](SweepOptions& o) { o.improving.seconds = value; }});
    }
    wrongs.push_back({"sweep.improve", [](SweepOptions& o) { o.improving.iterations = 0; }});
    wrongs.push_back({"sweep.improve", [](SweepOptions& o) { o.improving.rings = -1; }});
    const auto volume = test::sealed({.sides = 4});
    for (const Wrong& wrong : wrongs) {
        SweepOptions options = layers_of(3, 0.5);
        REQUIRE_NOTHROW(sweep::check(options));
        wrong.set(options);
        CAPTURE(wrong.code);
        CHECK(refusal_of([&] { sweep::check(options); }) == wrong.code);
        CHECK(refusal_of([&] { sweep::sweep(volume, options); }) == wrong.code);
    }
    for (const int threads : {-1, 1025, std::numeric_limits<int>::max()}) {
        RunContext context;
        context.threads = threads;
        CHECK(refusal_of([&] { sweep::sweep(volume, layers_of(3, 0.5), context); }) == "sweep.threads");
    }
    SweepOptions rows = layers_of(3, 0.5);
    rows.rows = 1;
    rows.row_height = size;
    for (const sweep::Quads quads : {sweep::Quads::automatic, sweep::Quads::paved}) {
        rows.quads = quads;
        CHECK_NOTHROW(sweep::check(rows));
    }
    rows.improving.seconds = infinity;
    CHECK_NOTHROW(sweep::check(rows));
}

TEST_CASE("a sweep stops when it is told to")
{
    const auto volume = test::sealed({.sides = 4});
    std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    CHECK_THROWS_AS(sweep::sweep(volume, layers_of(3, 0.2), context), Cancelled);
}

TEST_CASE("the quality a sweep tells is that of its cells, however they were placed, moved and proved")
{
    const auto check = [](const OpenVolume& volume, const SweepOptions& options) {
        const Swept swept = sweep::sweep(volume, options);
        const quality::Quality& told = swept.quality;
        const quality::Quality found = quality::measure(swept.mesh);
        CHECK(told.hexes == found.hexes);
        CHECK(told.wedges == found.wedges);
        CHECK(told.min_scaled_jacobian == found.min_scaled_jacobian);
        CHECK(told.min_scaled_jacobian == swept.min_scaled_jacobian);
        CHECK(told.mean_scaled_jacobian == found.mean_scaled_jacobian);
        CHECK(told.histogram == found.histogram);
        CHECK(told.volume == found.volume);
        REQUIRE(told.worst.size() == found.worst.size());
        for (std::size_t i = 0; i < found.worst.size(); ++i) {
            CHECK(told.worst[i].cell == found.worst[i].cell);
            CHECK(told.worst[i].layer == found.worst[i].layer);
            CHECK(told.worst[i].centre == found.worst[i].centre);
        }
        test::check_valid(swept.mesh);
    };
    for (const double twist : {0.0, 40.0, 80.0}) {
        CAPTURE(twist);
        const OpenVolume volume = test::sealed(
            {.sides = 5, .height = 2, .levels = 6, .twist = twist, .drop = without(false, false, true)});
        SweepOptions options = test::layers_of(6, 0.2);
        check(volume, options); // with the residual spread where that is good enough, or without
        options.improving.good_enough = 0.9;
        check(volume, options); // moved
        options.order = 2;
        check(volume, options);
    }
    const OpenVolume straight = test::sealed({.sides = 6, .height = 2, .taper = 0.8});
    SweepOptions rows = test::layers_of(6, 0.2);
    surface::BoundaryLayer& layer = rows.boundary_layers.emplace_back();
    layer.walls.tags.push_back(straight.model[straight.faces(Role::wall).front()].tag);
    layer.first = 0.02;
    layer.growth = 1.3;
    layer.count = 3;
    check(straight, rows);
}

TEST_CASE(
    "where a rim and an edge of the walls lie in one line, the refusal names the vertex and both edges")
{
    for (const double height : {0.3, 0.5, 0.8}) {
        for (const double size : {0.5, 0.2}) {
            CAPTURE(height);
            CAPTURE(size);
            SweepOptions options = test::layers_of(4, size);
            options.improving.work = 1; // nothing has to be tried to know it
            std::string message;
            try {
                sweep::sweep(box_with_bent_target(height), options);
            } catch (const NotSweepable& error) {
                message = error.what();
            }
            CHECK(message.find("at vertex ") != std::string::npos);
            CHECK(message.find("lie in one line") != std::string::npos);
            CHECK(message.find("edge ") != std::string::npos);
        }
    }
}
