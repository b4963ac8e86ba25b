// SPDX-License-Identifier: MIT
#include "support/edit_model.h"
#include "support/volumes.h"

#include <lacuna/core/error.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/split_edge.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::PrismOptions;

namespace {

/// A quarter turn by its angle, or a whole one.
class Circle : public geometry::ExactCurve {
public:
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& /*context*/) const override
    {
        for (std::size_t i = 0; i < params.size(); ++i)
            points[i] = {std::cos(params[i]), std::sin(params[i]), 0};
    }
};

/// Uses of each loop as they stand when it starts at its least one: what two loops must share to be the same.
std::vector<std::vector<EdgeUse>> canonical(const Face& face)
{
    std::vector<std::vector<EdgeUse>> loops;
    for (const Loop& loop : face.loops) {
        std::vector<EdgeUse> uses = loop.uses;
        std::rotate(uses.begin(), std::min_element(uses.begin(), uses.end()), uses.end());
        loops.push_back(uses);
    }
    std::sort(loops.begin(), loops.end());
    return loops;
}

/// What any model must be: chains end in their vertices, walks are closed, loops are what the facets say,
/// tags differ.
void check_model(const Model& model)
{
    for (const Edge& edge : model.edges) {
        CHECK(model[edge.from].point == edge.points.front());
        CHECK(model[edge.to].point == edge.points.back());
        CHECK(edge.points.size() >= 2);
        if (edge.curve) CHECK(edge.params.size() == edge.points.size());
    }
    std::set<int> vertices, edges;
    for (const Vertex& vertex : model.vertices) CHECK(vertices.insert(vertex.tag).second);
    for (const Edge& edge : model.edges) CHECK(edges.insert(edge.tag).second);
    const Model again = with_loops(model);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        for (const Loop& loop : model.faces[f].loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i)
                CHECK(use_to(model, loop.uses[i]) == use_from(model, loop.uses[(i + 1) % loop.uses.size()]));
        }
        CHECK((canonical(model.faces[f]) == canonical(again.faces[f])));
    }
}

std::string code_of(const std::function<void()>& work, const std::string& word)
{
    try {
        work();
    } catch (const Error& error) {
        const std::string what = error.what();
        CAPTURE(what);
        CHECK(what.find(word) != std::string::npos);
        return error.code();
    }
    return "done";
}

/// Edges that run along both sides of a facet each: a fan over a whole circle, its edge exact.
Model disc(int sides)
{
    healing::FacetSoup soup;
    soup.points.emplace_back(0, 0, 0);
    for (int i = 0; i < sides; ++i)
        soup.points.emplace_back(std::cos(2 * std::numbers::pi * i / sides),
                                 std::sin(2 * std::numbers::pi * i / sides), 0);
    for (int i = 0; i < sides; ++i) soup.triangles.push_back({0, i + 1, (i + 1) % sides + 1});
    healing::SplitOptions options;
    options.feature_angle = 120;
    ModelBuilder model(healing::split_facets(soup, options));
    REQUIRE(model.edges.size() == 1);
    Edge& edge = model.edges.front();
    edge.curve = std::make_shared<Circle>();
    const Vec3 start = model.at(edge.points.front());
    const double from = std::atan2(start.y(), start.x());
    const Vec3 second = model.at(edge.points[1]);
    const double step = std::atan2(start.cross(second).z(), start.dot(second));
    for (std::size_t i = 0; i < edge.points.size(); ++i)
        edge.params.push_back(from + step * static_cast<double>(i));
    return std::move(model).finish();
}

} // namespace

TEST_CASE(
    "a split edge has its two parts' lengths, and faces, loops and what they enclose stay what they were")
{
    std::mt19937 dice(5);
    std::uniform_real_distribution<double> chance(0.02, 0.98);
    int splits = 0;
    for (const int sides : {0, 3, 5}) {
        for (const int holes : {0, 2}) {
            for (const int rows : {1, 2}) {
                for (const double bend : {0.0, 60.0}) {
                    const Model whole =
                        test::prism({.sides = sides, .holes = holes, .rows = rows, .levels = 2, .bend = bend})
                            .model;
                    for (std::size_t e = 0; e < whole.edges.size(); ++e) {
                        Model model = whole;
                        const EdgeId edge(e);
                        const double f = chance(dice), length = edge_length(whole, edge);
                        CAPTURE(sides);
                        CAPTURE(e);
                        CAPTURE(f);
                        const EdgeSplit made = split_edge(model, edge, f);
                        check_model(model);
                        CHECK(edge_length(model, edge) == doctest::Approx(f * length));
                        CHECK(edge_length(model, made.behind) == doctest::Approx((1 - f) * length));
                        CHECK(model[edge].from == whole[edge].from);
                        CHECK(model[made.behind].to == whole[edge].to);
                        CHECK(model[edge].to == made.vertex);
                        CHECK(model[made.behind].from == made.vertex);
                        CHECK(model[edge].tag == whole[edge].tag);
                        for (const FaceId face : all_faces(model))
                            CHECK(face_area(model, face) == doctest::Approx(face_area(whole, face)));
                        CHECK(volume_integral(model, all_faces(model)) ==
                              doctest::Approx(volume_integral(whole, all_faces(whole))));
                        // Only the faces at the edge have changed.
                        for (std::size_t face = 0; face < whole.faces.size(); ++face) {
                            bool at_edge = false;
                            for (const Loop& loop : whole.faces[face].loops) {
                                for (const EdgeUse& use : loop.uses) at_edge = at_edge || use.edge == edge;
                            }
                            if (!at_edge)
                                CHECK(model.faces[face].triangles == whole.faces[face].triangles);
                            else
                                CHECK(model.faces[face].triangles.size() >
                                      whole.faces[face].triangles.size());
                        }
                        ++splits;
                    }
                }
            }
        }
    }
    MESSAGE(splits << " splits");
}

TEST_CASE("an edge can be split over and over, each part the next time")
{
    std::mt19937 dice(6);
    std::uniform_real_distribution<double> chance(0.2, 0.8);
    Model model = test::prism({.sides = 4, .holes = 1}).model;
    const double volume = volume_integral(model, all_faces(model));
    const std::size_t edges = model.edges.size(), vertices = model.vertices.size();
    for (int i = 0; i < 60; ++i) {
        const EdgeId edge(dice() % model.edges.size());
        split_edge(model, edge, chance(dice));
    }
    check_model(model);
    CHECK(model.edges.size() == edges + 60);
    CHECK(model.vertices.size() == vertices + 60);
    CHECK(volume_integral(model, all_faces(model)) == doctest::Approx(volume));
}

TEST_CASE("both uses of a seam are split, and the wall stays one loop")
{
    test::Prism prism = test::prism({.sides = 0, .levels = 3});
    const FaceId wall = prism.face({Role::wall, 0, 0, 0, 0});
    test::add_seam(prism.model, wall);
    std::set<EdgeId> met;
    EdgeId seam;
    for (const EdgeUse& use : prism.model[wall].loops.at(0).uses) {
        if (!met.insert(use.edge).second) seam = use.edge;
    }
    REQUIRE(seam.valid());
    for (const double f : {0.1, 0.4, 0.77}) {
        Model model = prism.model;
        const EdgeSplit made = split_edge(model, seam, f);
        check_model(model);
        REQUIRE(model[wall].loops.size() == 1);
        const auto& uses = model[wall].loops[0].uses;
        CHECK(uses.size() == prism.model[wall].loops[0].uses.size() + 2);
        for (const EdgeId part : {seam, made.behind}) {
            for (const bool reversed : {false, true})
                CHECK(std::count(uses.begin(), uses.end(), EdgeUse{part, reversed}) == 1);
        }
    }
}

TEST_CASE("the new vertex lies on the exact curve, its parameter between its neighbours'")
{
    for (const int sides : {4, 7, 30}) {
        for (int i = 1; i < 40; ++i) {
            Model model = disc(sides);
            const double f = i / 40.0;
            CAPTURE(sides);
            CAPTURE(f);
            const EdgeSplit made = split_edge(model, EdgeId(std::size_t(0)), f);
            check_model(model);
            const Vec3 at = model.at(model[made.vertex].point);
            CHECK(at.norm() == doctest::Approx(1).epsilon(1e-12));
            for (const Edge& edge : model.edges) {
                for (std::size_t k = 0; k < edge.points.size(); ++k) {
                    const Vec3 on(std::cos(edge.params[k]), std::sin(edge.params[k]), 0);
                    CHECK((model.at(edge.points[k]) - on).norm() < 1e-12);
                    if (k > 0)
                        CHECK((edge.params[k] > edge.params[k - 1]) == (edge.params[1] > edge.params[0]));
                }
            }
        }
    }
}

TEST_CASE("surface parameters of new corners lie between those of their facets' sides")
{
    const auto uv_of = [](const Vec3& p) { return Vec2(2 * p.x() + p.z() + 3, p.y() - p.z()); };
    Model whole = test::prism({.sides = 5, .holes = 1, .levels = 2}).model;
    test::edit(whole, [&](ModelBuilder& model) {
        for (Face& face : model.faces)
            for (const Triangle& t : face.triangles)
                face.uv.push_back({uv_of(model.at(t[0])), uv_of(model.at(t[1])), uv_of(model.at(t[2]))});
    });
    for (std::size_t e = 0; e < whole.edges.size(); ++e) {
        Model model = whole;
        split_edge(model, EdgeId(e), 0.37);
        for (const Face& face : model.faces) {
            REQUIRE(face.uv.size() == face.triangles.size());
            for (std::size_t t = 0; t < face.triangles.size(); ++t) {
                for (std::size_t k = 0; k < 3; ++k)
                    CHECK((face.uv[t][k] - uv_of(model.at(face.triangles[t][k]))).norm() < 1e-12);
            }
        }
    }
}

TEST_CASE("an inner point of the edge within the tolerance becomes the vertex, and facets stay")
{
    const Model whole = test::prism({.sides = 4, .cuts = 5, .levels = 4}).model;
    for (std::size_t e = 0; e < whole.edges.size(); ++e) {
        const auto inner = whole.edges[e].points.size() - 2;
        for (std::size_t i = 1; i <= inner; ++i) {
            Model model = whole;
            const double off = 0.5 * whole.tolerance / edge_length(whole, EdgeId(e));
            const EdgeSplit made = split_edge(model, EdgeId(e),
                                              static_cast<double>(i) / static_cast<double>(inner + 1) + off);
            CHECK(model[made.vertex].point == whole.edges[e].points[i]);
            CHECK(model.points.size() == whole.points.size());
            check_model(model);
        }
    }
}

TEST_CASE("the nodes of a mesh that a face came with get none between them")
{
    healing::FacetSoup soup;
    const int n = 4;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) soup.points.emplace_back(i, j, 0);
    }
    const auto at = [&](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i)
            soup.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    const Model whole = healing::split_facets(soup);
    REQUIRE(whole.faces.front().given_quads.size() == 16);
    for (std::size_t e = 0; e < whole.edges.size(); ++e) {
        for (const double f : {0.01, 0.3, 0.49, 0.6, 0.99}) {
            Model model = whole;
            const EdgeSplit made = split_edge(model, EdgeId(e), f);
            CHECK(model.points.size() == whole.points.size());
            CHECK(model.faces.front().given_quads == whole.faces.front().given_quads);
            CHECK(model.faces.front().triangles == whole.faces.front().triangles);
            // The nearest of the three inner nodes.
            const double wanted = std::clamp(std::round(f * n), 1.0, 3.0) / n;
            CHECK(edge_length(model, EdgeId(e)) == doctest::Approx(wanted * n));
            CHECK(model[made.vertex].point ==
                  whole.edges[e].points[static_cast<std::size_t>(std::lround(wanted * n))]);
            check_model(model);
        }
    }
    healing::FacetSoup one;
    one.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    one.quads = {{0, 1, 2, 3}};
    Model model = healing::split_facets(one);
    CHECK(code_of([&] { split_edge(model, EdgeId(std::size_t(0)), 0.5); },
                  name_of(model, EdgeId(std::size_t(0)))) == "topology.split_kept_mesh");
}

TEST_CASE("a split at an end of the edge is refused by the edge's name, and nothing has changed")
{
    const Model whole = test::prism({.sides = 3, .cuts = 1}).model;
    for (const double f : {0.0, 1.0, -1.0, 2.0, 1e-12, 1 - 1e-12, std::nan("")}) {
        Model model = whole;
        CHECK(code_of([&] { split_edge(model, EdgeId(std::size_t(1)), f); },
                      name_of(whole, EdgeId(std::size_t(1)))) == "topology.split_at_end");
        CHECK(model.points.size() == whole.points.size());
        CHECK(model.edges.size() == whole.edges.size());
    }
}
