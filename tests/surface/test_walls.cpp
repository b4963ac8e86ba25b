// SPDX-License-Identifier: MIT
#include "surface/sealed.h"

#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/walls.h>

#include <lacuna/core/error.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

using namespace lacuna;
using namespace lacuna::topology;
using surface::LinkingNodes;
using surface::LinkingSurface;
using test::PrismOptions;
using test::without;

namespace {

struct MeshedWalls {
    std::vector<LinkingSurface> links;
    std::vector<LinkingNodes> nodes;
    std::vector<surface::WallMesh> walls;
};

std::vector<double> levels(int layers)
{
    std::vector<double> heights;
    for (int k = 0; k <= layers; ++k) heights.push_back(static_cast<double>(k) / layers);
    return heights;
}

MeshedWalls meshed(const OpenVolume& volume, const std::vector<double>& heights, int sides_each)
{
    MeshedWalls result;
    result.links = surface::linking_surfaces(volume);
    for (const LinkingSurface& link : result.links) {
        std::vector<double> even;
        for (int k = 0; k < sides_each; ++k) even.push_back(static_cast<double>(k) / sides_each);
        const std::vector<std::vector<double>> shares(link.segments.size(), even);
        result.nodes.push_back(surface::linking_nodes(link, shares, shares));
    }
    result.walls = surface::mesh_walls(volume, result.links, result.nodes, heights);
    return result;
}

/// Rows first and last lie on the rims, every node on a wall, no quad turned over against its neighbours.
void check_walls(const OpenVolume& volume, const MeshedWalls& mesh, std::size_t layers, double closeness)
{
    for (std::size_t b = 0; b < mesh.walls.size(); ++b) {
        const auto& wall = mesh.walls[b];
        const std::size_t n = mesh.nodes[b].source_at.size();
        REQUIRE(wall.points.size() == n * (layers + 1));
        REQUIRE(wall.face.size() == n * layers);
        const auto low = mesh.links[b].source.points(mesh.nodes[b].source_at);
        for (std::size_t i = 0; i < n; ++i) CHECK(wall.points[i] == low[i]);
        std::vector<Triangle> triangles;
        for (const FaceId face : mesh.links[b].walls) {
            const auto& more = volume.model[face].triangles;
            triangles.insert(triangles.end(), more.begin(), more.end());
        }
        const geometry::FacetTree tree(volume.model.points, triangles);
        double worst = 0;
        for (const Vec3& p : wall.points) worst = std::max(worst, (tree.closest(p).point - p).norm());
        CHECK(worst <= closeness * volume.model.diagonal);
        std::size_t folded = 0;
        for (std::size_t k = 0; k < layers; ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                const auto at = [&](std::size_t row, std::size_t column) {
                    return wall.points[row * n + column % n];
                };
                const std::array<Vec3, 4> c{at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)};
                const Vec3 normal = (c[2] - c[0]).cross(c[3] - c[1]);
                for (std::size_t j = 0; j < 4; ++j)
                    folded += (c[(j + 1) % 4] - c[j]).cross(c[(j + 3) % 4] - c[j]).dot(normal) <= 0 ? 1 : 0;
            }
        }
        CHECK(folded == 0);
        for (const FaceId face : wall.face)
            CHECK(std::find(mesh.links[b].walls.begin(), mesh.links[b].walls.end(), face) !=
                  mesh.links[b].walls.end());
    }
}

} // namespace

TEST_CASE("nodes of walls lie on them, unfolded, whatever the walls are made of")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 6}) {
        for (const int holes : {0, 2}) {
            for (const int rows : {1, 2}) {
                for (const int pieces : {1, 2}) {
                    for (const double twist : {0.0, 25.0}) {
                        for (const double bend : {0.0, 60.0}) {
                            const auto volume = test::sealed({.sides = sides,
                                                              .height = 4,
                                                              .holes = holes,
                                                              .hole_sides = sides,
                                                              .cuts = 3,
                                                              .rows = rows,
                                                              .pieces = pieces,
                                                              .levels = 8,
                                                              .twist = twist,
                                                              .taper = 0.8,
                                                              .bend = bend});
                            CAPTURE(sides);
                            CAPTURE(holes);
                            CAPTURE(rows);
                            CAPTURE(pieces);
                            CAPTURE(twist);
                            CAPTURE(bend);
                            check_walls(volume, meshed(volume, levels(6), sides == 0 && pieces == 1 ? 16 : 4),
                                        6, 1e-9);
                            ++combinations;
                        }
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " sets of walls");
}

TEST_CASE("nodes of void walls lie near their facets, unfolded")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 5}) {
        for (const int holes : {0, 1}) {
            for (const double twist : {0.0, 20.0}) {
                for (const double bend : {0.0, 40.0}) {
                    for (const auto& drop : {without(false, false, true), without(false, false, false, {0}),
                                             without(false, false, false, {0, 1})}) {
                        const auto volume = test::sealed({.sides = sides,
                                                          .height = 4,
                                                          .holes = holes,
                                                          .cuts = 4,
                                                          .levels = 8,
                                                          .twist = twist,
                                                          .taper = 0.8,
                                                          .bend = bend,
                                                          .drop = drop});
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(twist);
                        CAPTURE(bend);
                        check_walls(volume, meshed(volume, levels(6), sides == 0 ? 16 : 4), 6, 0.02);
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " sets of void walls");
}

TEST_CASE("rows of straight walls lie at their heights, whatever the spacing")
{
    const std::vector<double> heights{0, 0.05, 0.3, 0.35, 0.9, 1};
    for (const int sides : {0, 4, 5}) {
        for (const bool missing : {false, true}) {
            const auto volume = test::sealed(
                {.sides = sides, .height = 3, .taper = 0.9, .drop = without(false, false, missing)});
            const auto mesh = meshed(volume, heights, sides == 0 ? 16 : 3);
            const std::size_t n = mesh.nodes[0].source_at.size();
            CAPTURE(sides);
            CAPTURE(missing);
            for (std::size_t k = 0; k < heights.size(); ++k) {
                for (std::size_t i = 0; i < n; ++i)
                    CHECK(mesh.walls[0].points[k * n + i].z() ==
                          doctest::Approx(3 * heights[k]).epsilon(1e-6));
            }
        }
    }
}

TEST_CASE(
    "an edge between stacked walls is met by a layer, and quads on either side belong to the wall there")
{
    int combinations = 0;
    for (const int sides : {0, 4}) {
        for (const int rows : {2, 3}) {
            for (const int layers : {3, 4, 7, 12}) {
                if (layers < rows) continue;
                const double height = 3;
                const auto volume = test::sealed(
                    {.sides = sides, .height = height, .rows = rows, .levels = 2});
                const auto mesh = meshed(volume, levels(layers), sides == 0 ? 16 : 3);
                const std::size_t n = mesh.nodes[0].source_at.size();
                CAPTURE(sides);
                CAPTURE(rows);
                CAPTURE(layers);
                std::map<FaceId, std::pair<double, double>> span;
                for (const FaceId wall : mesh.links[0].walls) {
                    double low = 1e300, high = -1e300;
                    for (const Triangle& t : volume.model[wall].triangles) {
                        for (const Index p : t) {
                            low = std::min(low, volume.model.at(p).z());
                            high = std::max(high, volume.model.at(p).z());
                        }
                    }
                    span[wall] = {low, high};
                }
                std::size_t across = 0;
                for (std::size_t k = 0; k < static_cast<std::size_t>(layers); ++k) {
                    for (std::size_t i = 0; i < n; ++i) {
                        const auto [low, high] = span.at(mesh.walls[0].face[k * n + i]);
                        for (const std::size_t corner :
                             {k * n + i, k * n + (i + 1) % n, (k + 1) * n + i, (k + 1) * n + (i + 1) % n}) {
                            const double z = mesh.walls[0].points[corner].z();
                            across += z < low - 1e-6 || z > high + 1e-6 ? 1 : 0;
                        }
                    }
                }
                CHECK(across == 0);
                CHECK(mesh.walls[0].notes.empty());
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " stacks");
}

TEST_CASE("more rings than layers are refused, and the layers that would do are named")
{
    const auto volume = test::sealed({.sides = 4, .rows = 4});
    try {
        meshed(volume, levels(2), 2);
        FAIL_CHECK("three rings on one layer");
    } catch (const NotSweepable& error) {
        CHECK(error.code() == "surface.too_few_layers");
        CHECK(error.message().found() == std::vector<MessageValue>{2LL});
        CHECK(error.message().needed() == std::vector<MessageValue>{4LL});
    }
    check_walls(volume, meshed(volume, levels(4), 2), 4, 1e-9);
}

TEST_CASE("rows of a tapered round wall without side lines lie at their heights")
{
    test::PrismOptions options;
    options.sides = 0;
    options.cuts = 3;
    options.height = 3;
    options.taper = 0.3;
    options.levels = 12;
    const std::vector<double> heights{0, 0.1, 0.3, 0.5, 0.75, 1};
    const auto volume = test::sealed(options);
    const auto mesh = meshed(volume, heights, 16);
    const std::size_t n = mesh.nodes[0].source_at.size();
    for (std::size_t k = 0; k < heights.size(); ++k) {
        for (std::size_t i = 0; i < n; ++i)
            CHECK(std::abs(mesh.walls[0].points[k * n + i].z() - 3 * heights[k]) < 0.06);
    }
}
