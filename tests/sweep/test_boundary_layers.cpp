// SPDX-License-Identifier: MIT
#include "layers_of.h"
#include "support/check_valid.h"
#include "support/edit_model.h"
#include "support/refusal.h"
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/surface/shared/boundary_layers.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweepOptions;
using sweep::Swept;
using test::End;
using test::Part;
using test::PrismOptions;

namespace {

/// Heights square to ends, as a share: layers are moved until they are met to a fifth of a percent.
constexpr double kClose = 2e-3;

surface::BoundaryLayer layer_on(const OpenVolume& volume, const std::vector<FaceId>& faces, double first,
                                double growth, int count)
{
    surface::BoundaryLayer layer;
    for (const FaceId face : faces) layer.walls.tags.push_back(volume.model[face].tag);
    layer.first = first;
    layer.growth = growth;
    layer.count = count;
    return layer;
}

/// Faces of the walls by their side, of the outer loop or of a hole, in the volume's own model.
std::vector<FaceId> walls_of(const OpenVolume& volume, const test::Prism& prism, int loop,
                             const std::vector<int>& sides)
{
    std::vector<FaceId> faces;
    for (std::size_t f = 0; f < prism.model.faces.size(); ++f) {
        const Part& part = prism.part[f];
        if (part.role != Role::wall || part.loop != loop) continue;
        if (!sides.empty() && std::find(sides.begin(), sides.end(), part.side) == sides.end()) continue;
        for (std::size_t own = 0; own < volume.model.faces.size(); ++own) {
            if (volume.model.faces[own].tag == prism.model.faces[f].tag &&
                volume.model.faces[own].origin == Origin::given)
                faces.emplace_back(own);
        }
    }
    return faces;
}

/// Rows over the quads of a patch, by the cells behind them: height of each row's nodes over their feet,
/// square to the quad there, least and most.
struct Row {
    double least = 1e300, most = -1e300;
};

std::vector<Row> rows_over(const mesh::HexMesh& mesh, const std::set<std::size_t>& patches, int count)
{
    std::map<std::pair<Index, Index>, std::vector<std::size_t>> cells; // of a side of the source's quads
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Index a = mesh.quads[q][k], b = mesh.quads[q][(k + 1) % 4];
            cells[{std::min(a, b), std::max(a, b)}].push_back(q);
        }
    }
    std::vector<Row> rows(static_cast<std::size_t>(count));
    for (std::size_t w = 0; w < mesh.wall_patch.size(); ++w) {
        if (!patches.contains(index(mesh.wall_patch[w]))) continue;
        const std::size_t layer = w / mesh.rim.size();
        Index a = mesh.rim[w % mesh.rim.size()][0], b = mesh.rim[w % mesh.rim.size()][1];
        const auto at = [&](std::size_t l, Index node) -> const Vec3& {
            return mesh.nodes[l * index(mesh.nodes_per_layer) + index(node)];
        };
        const Index foot_a = a, foot_b = b;
        Vec3 normal = (at(layer + 1, b) - at(layer, a)).cross(at(layer + 1, a) - at(layer, b)).normalized();
        std::size_t from = mesh.quads.size();
        for (int r = 0; r < count; ++r) {
            const auto& beside = cells.at({std::min(a, b), std::max(a, b)});
            const std::size_t q = beside.front() == from ? beside.back() : beside.front();
            REQUIRE(q != from);
            from = q;
            const Quad& quad = mesh.quads[q];
            std::size_t k = 0;
            while (edge_key(quad[k], quad[(k + 1) % 4]) != edge_key(a, b)) ++k;
            const bool along = quad[k] == a;
            a = quad[(k + (along ? 3 : 2)) % 4];
            b = quad[(k + (along ? 2 : 3)) % 4];
            for (const std::size_t l : {layer, layer + 1}) {
                for (const Index node : {a, b}) {
                    double height = (at(l, node) - at(l, node == a ? foot_a : foot_b)).dot(normal);
                    if (r == 0 && height < 0) {
                        normal = -normal;
                        height = -height;
                    }
                    rows[static_cast<std::size_t>(r)].least = std::min(
                        rows[static_cast<std::size_t>(r)].least, height);
                    rows[static_cast<std::size_t>(r)].most = std::max(rows[static_cast<std::size_t>(r)].most,
                                                                      height);
                }
            }
        }
    }
    return rows;
}

/// Whether every row over the faces has its height, to a share of it.
void check_rows(const Swept& swept, const std::vector<FaceId>& faces, const surface::BoundaryLayer& layer,
                double share)
{
    std::set<std::size_t> patches;
    for (std::size_t p = 0; p < swept.faces.size(); ++p) {
        if (std::find(faces.begin(), faces.end(), swept.faces[p]) != faces.end()) patches.insert(p);
    }
    REQUIRE(patches.size() == faces.size());
    const std::vector<Row> rows = rows_over(swept.mesh, patches, layer.count);
    const std::vector<double> heights = surface::row_heights(layer);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        CAPTURE(r);
        CHECK(rows[r].least >= heights[r] * (1 - share));
        CHECK(rows[r].most <= heights[r] * (1 + share));
    }
}

SweepOptions with_rows(std::vector<surface::BoundaryLayer> layers, double size = 0.3, int count = 3)
{
    SweepOptions options = test::layers_of(count, size);
    options.boundary_layers = std::move(layers);
    return options;
}

} // namespace

TEST_CASE("heights of rows grow by the ratio from the first")
{
    surface::BoundaryLayer layer;
    layer.first = 0.02;
    layer.growth = 1.5;
    layer.count = 4;
    const std::vector<double> heights = surface::row_heights(layer);
    REQUIRE(heights.size() == 4);
    CHECK(heights[0] == doctest::Approx(0.02));
    for (std::size_t i = 2; i < 4; ++i) {
        CHECK((heights[i] - heights[i - 1]) / (heights[i - 1] - heights[i - 2]) == doctest::Approx(1.5));
    }
}

TEST_CASE("rows have their thickness along any walls of straight prisms, tapered ones too")
{
    for (const int sides : {3, 4, 5, 6}) {
        for (const double taper : {1.0, 0.6, 1.5}) {
            for (const int holes : {0, 1}) {
                for (const std::vector<int>& chosen : {std::vector<int>{0}, std::vector<int>{0, 1},
                                                       std::vector<int>{0, 2}, std::vector<int>{}}) {
                    CAPTURE(sides);
                    CAPTURE(taper);
                    CAPTURE(holes);
                    CAPTURE(chosen.size());
                    PrismOptions how;
                    how.sides = sides;
                    how.taper = taper;
                    how.holes = holes;
                    const test::Prism prism = test::prism(how);
                    const OpenVolume volume = test::sealed(how);
                    const std::vector<FaceId> walls = walls_of(volume, prism, 0, chosen);
                    const auto layer = layer_on(volume, walls, 0.01, 1.4, 3);
                    const Swept swept = sweep::sweep(volume, with_rows({layer}));
                    test::check_valid(swept.mesh);
                    CHECK(swept.min_scaled_jacobian > 0.2);
                    check_rows(swept, walls, layer, 1e-6);
                }
            }
        }
    }
}

TEST_CASE("rows run round holes, with corners and round")
{
    for (const int hole_sides : {0, 3, 4, 6}) {
        for (const int holes : {1, 3}) {
            for (const double taper : {1.0, 0.7}) {
                CAPTURE(hole_sides);
                CAPTURE(holes);
                PrismOptions how;
                how.sides = 0;
                how.holes = holes;
                how.hole_sides = hole_sides;
                how.taper = taper;
                const test::Prism prism = test::prism(how);
                const OpenVolume volume = test::sealed(how);
                const std::vector<FaceId> walls = walls_of(volume, prism, 1, {});
                const auto layer = layer_on(volume, walls, 0.006, 1.3, 3);
                const Swept swept = sweep::sweep(volume, with_rows({layer}, 0.2));
                test::check_valid(swept.mesh);
                // Heights are the mean over the quads at a node; those of a cone are warped, and turn to it.
                check_rows(swept, walls, layer, hole_sides == 0 ? 0.1 : 1e-6);
            }
        }
    }
}

TEST_CASE("rows keep their thickness along walls that turn, bulge and bend, whatever the ends are")
{
    int meshed = 0, tried = 0;
    for (const int sides : {0, 4, 5}) {
        for (const double twist : {0.0, 30.0}) {
            for (const double belly : {1.0, 1.2}) {
                for (const double bend : {0.0, 60.0}) {
                    for (const End end : {End::planar, End::tilted, End::bowed}) {
                        if (belly != 1 && bend != 0) continue;
                        CAPTURE(sides);
                        CAPTURE(twist);
                        CAPTURE(belly);
                        CAPTURE(bend);
                        CAPTURE(static_cast<int>(end));
                        PrismOptions how;
                        how.sides = sides;
                        how.twist = twist;
                        how.belly = belly;
                        how.bend = bend;
                        how.target = end;
                        how.levels = 8;
                        how.lift = 0.2;
                        const test::Prism prism = test::prism(how);
                        const OpenVolume volume = test::sealed(how);
                        const std::vector<FaceId> walls = walls_of(
                            volume, prism, 0, sides == 0 ? std::vector<int>{} : std::vector<int>{0, 1});
                        const auto layer = layer_on(volume, walls, 0.02, 1.3, 3);
                        ++tried;
                        try {
                            const Swept swept = sweep::sweep(volume, with_rows({layer}, 0.25, 8));
                            test::check_valid(swept.mesh);
                            // Heights over single quads, where the sweep goes by the mean of those at a node.
                            check_rows(swept, walls, layer, 0.25);
                            ++meshed;
                        } catch (const NotSweepable& error) {
                            MESSAGE(error.what());
                        }
                    }
                }
            }
        }
    }
    MESSAGE(meshed << " of " << tried << " meshed");
    CHECK(meshed == tried);
}

TEST_CASE("rows lie along walls of every class, given and void")
{
    struct Missing {
        bool source, target, walls;
        std::vector<int> sides;
    };
    for (const Missing& missing :
         {Missing{false, false, true, {}}, Missing{true, false, false, {}}, Missing{false, true, false, {}},
          Missing{false, false, false, {1}}, Missing{true, true, false, {}}}) {
        PrismOptions how;
        how.sides = 4;
        how.drop = test::without(missing.source, missing.target, missing.walls, missing.sides);
        const test::Prism prism = test::prism(how);
        const OpenVolume volume = test::sealed(how);
        surface::BoundaryLayer layer;
        layer.walls.names = {"walls"};
        layer.first = 0.02;
        layer.growth = 1.2;
        layer.count = 3;
        const Swept swept = sweep::sweep(volume, with_rows({layer}));
        test::check_valid(swept.mesh);
        check_rows(swept, volume.faces(Role::wall), layer, 1e-6);
    }
}

TEST_CASE("walls that meet in a corner may have tables of their own")
{
    for (const int sides : {3, 4, 5}) {
        CAPTURE(sides);
        PrismOptions how;
        how.sides = sides;
        how.holes = 1;
        const test::Prism prism = test::prism(how);
        const OpenVolume volume = test::sealed(how);
        const auto a = walls_of(volume, prism, 0, {0}), b = walls_of(volume, prism, 0, {1}),
                   c = walls_of(volume, prism, 1, {0}), d = walls_of(volume, prism, 1, {1});
        const std::vector<surface::BoundaryLayer> layers{
            layer_on(volume, a, 0.01, 1.5, 4), layer_on(volume, b, 0.03, 1, 2),
            layer_on(volume, c, 0.01, 1.2, 3), layer_on(volume, d, 0.02, 1.1, 2)};
        const Swept swept = sweep::sweep(volume, with_rows(layers, 0.2));
        test::check_valid(swept.mesh);
        check_rows(swept, a, layers[0], 1e-6);
        check_rows(swept, b, layers[1], 1e-6);
        check_rows(swept, c, layers[2], 1e-6);
        check_rows(swept, d, layers[3], 1e-6);
    }
}

TEST_CASE("layers along ends have their heights, whatever columns do between")
{
    for (const double twist : {0.0, 30.0}) {
        for (const double taper : {1.0, 0.7}) {
            for (const bool both : {false, true}) {
                CAPTURE(twist);
                CAPTURE(taper);
                PrismOptions how;
                how.sides = 5;
                how.twist = twist;
                how.taper = taper;
                how.levels = 6;
                const test::Prism prism = test::prism(how);
                const OpenVolume volume = test::sealed(how);
                surface::BoundaryLayer layer;
                for (const FaceId face : volume.faces(Role::source))
                    layer.walls.tags.push_back(volume.model[face].tag);
                if (both) layer.walls.tags.push_back(volume.model[volume.faces(Role::target).front()].tag);
                layer.first = 0.05;
                layer.growth = 1.5;
                layer.count = 3;
                const Swept swept = sweep::sweep(volume, with_rows({layer}, 0.3, 9));
                test::check_valid(swept.mesh);
                REQUIRE(swept.mesh.layers == 9);
                const std::vector<double> heights = surface::row_heights(layer);
                const std::size_t n = index(swept.mesh.nodes_per_layer);
                double low = 1e300, high = -1e300;
                for (const Vec3& p : swept.mesh.nodes) {
                    low = std::min(low, p.z());
                    high = std::max(high, p.z());
                }
                const bool up = swept.mesh.nodes.front().z() < (low + high) / 2;
                for (std::size_t j = 0; j < heights.size(); ++j) {
                    for (std::size_t i = 0; i < n; ++i) {
                        const std::size_t from_low = up ? j + 1 : 9 - j - 1, from_high = 9 - from_low;
                        CHECK(swept.mesh.nodes[from_low * n + i].z() - low ==
                              doctest::Approx(heights[j]).epsilon(kClose));
                        if (both)
                            CHECK(high - swept.mesh.nodes[from_high * n + i].z() ==
                                  doctest::Approx(heights[j]).epsilon(kClose));
                    }
                }
            }
        }
    }
}

TEST_CASE("rows without room are refused by wall and edge, with the room there is")
{
    PrismOptions how;
    how.sides = 4;
    const test::Prism prism = test::prism(how);
    const OpenVolume volume = test::sealed(how);
    const auto walls = walls_of(volume, prism, 0, {0, 2});
    const auto thick = layer_on(volume, walls, 0.4, 1.2, 3);
    CHECK(test::refusal([&] { sweep::sweep(volume, with_rows({thick})); },
                        {name_of(volume.model, walls[0]), "edge", "room for"}) == "surface.layers_room");

    how.sides = 0;
    how.holes = 1;
    how.hole_sides = 0;
    const test::Prism ring = test::prism(how);
    const OpenVolume tube = test::sealed(how);
    const auto all = layer_on(tube, tube.faces(Role::wall), 0.2, 1.2, 3);
    CHECK(test::refusal([&] { sweep::sweep(tube, with_rows({all})); },
                        {"edge", "0.728", "up to the opposite side"}) == "surface.layers_room");

    const auto ends = layer_on(volume, volume.faces(Role::source), 3, 1, 1);
    CHECK(test::refusal([&] { sweep::sweep(volume, with_rows({ends})); }, {"apart"}) == "sweep.layers_room");
}

TEST_CASE("boundary layers that say nothing, or twice, are refused")
{
    const PrismOptions how;
    const test::Prism prism = test::prism(how);
    const OpenVolume volume = test::sealed(how);
    const auto walls = walls_of(volume, prism, 0, {0});
    const auto good = layer_on(volume, walls, 0.1, 1, 1);
    const auto refused = [&](surface::BoundaryLayer layer) {
        return test::refusal([&] { sweep::sweep(volume, with_rows({std::move(layer)})); });
    };
    auto layer = good;
    layer.first = 0;
    CHECK(refused(layer) == "sweep.boundary_layers");
    layer = good;
    layer.growth = -1;
    CHECK(refused(layer) == "sweep.boundary_layers");
    layer = good;
    layer.count = 0;
    CHECK(refused(layer) == "sweep.boundary_layers");
    layer = good;
    layer.walls.tags = {12345};
    CHECK(refused(layer) == "surface.no_such_face");
    layer.walls = {};
    CHECK(refused(layer) == "sweep.boundary_layers");
    CHECK(test::refusal([&] { sweep::sweep(volume, with_rows({good, good})); }) == "surface.two_layers");
    SweepOptions rows = with_rows({good});
    rows.rows = 1;
    CHECK(test::refusal([&] { sweep::sweep(volume, rows); }) == "sweep.boundary_layers");
}

TEST_CASE("walls that go on into each other without a corner must have one table")
{
    PrismOptions how;
    how.sides = 4;
    how.pieces = 2;
    const test::Prism prism = test::prism(how);
    const OpenVolume volume = test::sealed(how);
    const auto walls = walls_of(volume, prism, 0, {0});
    REQUIRE(walls.size() == 2);
    const auto one = layer_on(volume, {walls[0]}, 0.05, 1, 2),
               other = layer_on(volume, {walls[1]}, 0.1, 1, 2);
    CHECK(test::refusal(
              [&] {
                  sweep::sweep(volume, with_rows({one, other}));
              },
              {name_of(volume.model, walls[0])}) == "surface.layers_meet");
    const auto both = layer_on(volume, walls, 0.05, 1, 2);
    const Swept swept = sweep::sweep(volume, with_rows({both}));
    test::check_valid(swept.mesh);
    check_rows(swept, walls, both, 1e-6);
    // One of them alone: its rows end in the middle of the side.
    const Swept half = sweep::sweep(volume, with_rows({one}));
    test::check_valid(half.mesh);
    check_rows(half, {walls[0]}, one, 1e-6);
}

TEST_CASE("rows cross and end on edges between the faces of an end, on leaning walls too")
{
    for (const double lean : {0.0, 0.3}) {
        CAPTURE(lean);
        OpenVolume volume = test::board_box(3, 2, 1.5);
        test::edit(volume.model, [lean](topology::ModelBuilder& model) {
            const Vec3 middle(1.5, 1, 0);
            for (Vec3& p : model.points) p += lean * p.z() * Vec3(p.x() - middle.x(), p.y() - middle.y(), 0);
        });
        surface::BoundaryLayer layer;
        layer.walls.names = {"walls"};
        layer.first = 0.02;
        layer.growth = 1.5;
        layer.count = 3;
        const Swept swept = sweep::sweep(volume, with_rows({layer}, 0.3));
        test::check_valid(swept.mesh);
        CHECK(swept.min_scaled_jacobian > 0.3);
        check_rows(swept, volume.faces(Role::wall), layer, 1e-3);
    }
}

TEST_CASE("the same rows come out for any number of threads")
{
    PrismOptions how;
    how.sides = 5;
    how.taper = 0.7;
    const test::Prism prism = test::prism(how);
    const OpenVolume volume = test::sealed(how);
    const auto layer = layer_on(volume, walls_of(volume, prism, 0, {0, 1}), 0.02, 1.3, 3);
    std::vector<std::vector<Vec3>> nodes;
    for (const int threads : {1, 3}) {
        RunContext context;
        context.threads = threads;
        nodes.push_back(sweep::sweep(volume, with_rows({layer}), context).mesh.nodes);
    }
    CHECK(nodes[0] == nodes[1]);
}
