// SPDX-License-Identifier: MIT
#include "support/edit_model.h"
#include "support/volumes.h"

#include <lacuna/core/error.h>
#include <lacuna/healing/split_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <type_traits>
#include <utility>

using namespace lacuna;
using namespace lacuna::topology;
using test::End;
using test::Part;
using test::PrismOptions;

namespace {

/// Every loop is a closed walk; the walk's directed segments are sides of the face's facets with the face
/// on the left.
void check_loops(const Model& model)
{
    for (const Face& face : model.faces) {
        std::set<std::pair<Index, Index>> sides;
        for (const Triangle& t : face.triangles) {
            for (std::size_t i = 0; i < 3; ++i) sides.emplace(t[i], t[(i + 1) % 3]);
        }
        std::set<std::pair<Index, Index>> walked;
        for (const Loop& loop : face.loops) {
            REQUIRE(!loop.uses.empty());
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                CHECK(use_to(model, loop.uses[i]) == use_from(model, loop.uses[(i + 1) % loop.uses.size()]));
                const std::vector<Index> points = use_points(model, loop.uses[i]);
                for (std::size_t k = 0; k + 1 < points.size(); ++k) {
                    CHECK(sides.contains({points[k], points[k + 1]}));
                    CHECK(walked.emplace(points[k], points[k + 1]).second);
                }
            }
        }
        for (const auto& [a, b] : sides) {
            if (!sides.contains({b, a})) CHECK(walked.contains({a, b}));
        }
    }
}

/// A face of its own edges over given facets: one edge a side between points named as vertices.
Model by_hand(std::vector<Vec3> points, const std::vector<std::vector<Triangle>>& faces,
              const std::vector<std::vector<Index>>& edges)
{
    ModelBuilder model;
    model.points = std::move(points);
    model.tolerance = 1e-9;
    model.diagonal = 1;
    std::map<Index, VertexId> vertex;
    const auto vertex_at = [&](Index p) {
        const auto [found, fresh] = vertex.try_emplace(p, VertexId(model.vertices.size()));
        if (fresh) model.vertices.push_back({p, static_cast<int>(model.vertices.size()) + 1, Origin::given});
        return found->second;
    };
    for (const std::vector<Index>& chain : edges) {
        Edge edge;
        edge.tag = static_cast<int>(model.edges.size()) + 1;
        edge.from = vertex_at(chain.front());
        edge.to = vertex_at(chain.back());
        edge.points = chain;
        model.edges.push_back(edge);
    }
    for (const auto& triangles : faces) {
        Face face;
        face.tag = static_cast<int>(model.faces.size()) + 1;
        face.triangles = triangles;
        model.faces.push_back(face);
    }
    return std::move(model).finish();
}

} // namespace

TEST_CASE("loops are closed walks with the face on the left, whatever the section, the rows and the order of "
          "the facets")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 7}) {
        for (const int holes : {0, 1, 3}) {
            for (const int rows : {1, 2}) {
                for (const int pieces : {1, 2}) {
                    const auto prism = test::prism({.sides = sides,
                                                    .holes = holes,
                                                    .hole_sides = sides,
                                                    .rows = rows,
                                                    .pieces = pieces});
                    healing::SplitOptions split;
                    split.whole_labels = true;
                    for (unsigned seed = 0; seed < 3; ++seed) {
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(rows);
                        CAPTURE(pieces);
                        CAPTURE(seed);
                        Model model = healing::split_facets(test::scrambled_facets(prism.soup, seed), split);
                        check_loops(model);
                        orient_consistently(model);
                        check_loops(model);
                        ++combinations;
                        for (std::size_t f = 0; f < model.faces.size(); ++f) {
                            const std::size_t ends = model.faces[f].loops.size();
                            const bool closed_wall = sides == 0 && pieces == 1;
                            CHECK((ends == 1 || ends == static_cast<std::size_t>(holes) + 1 ||
                                   (closed_wall && ends == 2)));
                        }
                        std::vector<FaceId> all;
                        for (std::size_t f = 0; f < model.faces.size(); ++f) all.emplace_back(f);
                        CHECK(volume_integral(model, all) == doctest::Approx(prism.facet_volume));
                        for (std::size_t e = 0; e < model.edges.size(); ++e) {
                            const auto uses = model.uses_of_edge(EdgeId(e));
                            REQUIRE(uses.size() == 2);
                            CHECK(uses[0].reversed != uses[1].reversed);
                        }
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " prisms");
}

TEST_CASE("the rim of an end with holes has one loop each, the longest first")
{
    const auto prism = test::prism({.sides = 6, .holes = 5, .hole_sides = 0});
    const Face& source = prism.model[prism.face({Role::source, 0, 0, 0, 0})];
    REQUIRE(source.loops.size() == 6);
    double before = 1e300;
    for (const Loop& loop : source.loops) {
        double length = 0;
        for (const EdgeUse& use : loop.uses) length += edge_length(prism.model, use.edge);
        CHECK(length <= before);
        before = length;
    }
    CHECK(source.loops.front().uses.size() == 6);
    for (std::size_t l = 1; l < 6; ++l) CHECK(source.loops[l].uses.size() == 1);
}

TEST_CASE("a closed wall has two loops without a seam, and one of four uses with one, the seam used twice")
{
    for (const int levels : {1, 3}) {
        auto prism = test::prism({.sides = 0, .levels = levels});
        const FaceId wall = prism.face({Role::wall, 0, 0, 0, 0});
        REQUIRE(prism.model[wall].loops.size() == 2);
        test::add_seam(prism.model, wall);
        check_loops(prism.model);
        REQUIRE(prism.model[wall].loops.size() == 1);
        const Loop& loop = prism.model[wall].loops.front();
        REQUIRE(loop.uses.size() == 4);
        std::map<EdgeId, int> uses;
        for (const EdgeUse& use : loop.uses) uses[use.edge] += use.reversed ? -1 : 1;
        const EdgeId seam(prism.model.edges.size() - 1);
        CHECK(uses.at(seam) == 0);
        CHECK(uses.size() == 3);
        const auto by_seam = prism.model.uses_of_edge(seam);
        REQUIRE(by_seam.size() == 2);
        CHECK(by_seam[0].face == wall);
        CHECK(by_seam[1].face == wall);
        orient_consistently(prism.model);
        CHECK(connected_parts(prism.model, {wall}).size() == 1);
    }
}

TEST_CASE("two loops of one face that touch in a vertex are told apart by the facets between them")
{
    // Two squares of one face, corner to corner at point 2.
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
    Model model = by_hand(points, {{{0, 1, 2}, {0, 2, 3}, {2, 4, 5}, {2, 5, 6}}},
                          {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {2, 4}, {4, 5}, {5, 6}, {6, 2}});
    model = with_loops(model);
    check_loops(model);
    REQUIRE(model.faces[0].loops.size() == 2);
    for (const Loop& loop : model.faces[0].loops) CHECK(loop.uses.size() == 4);
}

TEST_CASE("a hole that touches the outer border in a vertex makes one walk that passes the vertex twice")
{
    // A triangle with a triangular hole whose corner is the outer corner 0: two strips that meet in one
    // point.
    const std::vector<Vec3> points{{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {2, 1, 0}, {1, 2, 0}};
    Model model = by_hand(points, {{{0, 1, 3}, {3, 1, 2}, {3, 2, 4}, {4, 2, 0}}},
                          {{0, 1}, {1, 2}, {2, 0}, {0, 4}, {4, 3}, {3, 0}});
    model = with_loops(model);
    check_loops(model);
    REQUIRE(model.faces[0].loops.size() == 1);
    CHECK(model.faces[0].loops[0].uses.size() == 6);
}

TEST_CASE("facets that overlap, and a border that leaves its edges, are refused and the face named")
{
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const std::vector<std::vector<Index>> edges{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    const auto code_of = [](Model model) {
        test::edit(model, [](ModelBuilder& tagged) { tagged.faces[0].tag = 17; });
        try {
            model = with_loops(model);
        } catch (const InvalidInput& error) {
            CHECK(std::string(error.what()).find("face 17") != std::string::npos);
            return error.code();
        }
        return std::string("taken");
    };
    CHECK(code_of(by_hand(points, {{{0, 1, 2}, {0, 2, 3}, {0, 1, 3}}}, edges)) == "topology.not_manifold");
    CHECK(code_of(by_hand(points, {{{0, 1, 2}, {0, 3, 2}}}, edges)) == "topology.not_manifold");
    CHECK(code_of(by_hand(points, {{{0, 1, 2}, {0, 2, 3}}}, {{0, 1}, {1, 2}, {2, 3}})) ==
          "topology.loose_border");
}

TEST_CASE("orientation is consistent and outward whichever faces come turned over")
{
    const auto prism = test::prism({.sides = 5, .holes = 2, .hole_sides = 3});
    const std::size_t faces = prism.model.faces.size();
    std::vector<FaceId> all;
    for (std::size_t f = 0; f < faces; ++f) all.emplace_back(f);
    int combinations = 0;
    for (unsigned bits = 0; bits < (1U << faces); bits += 5) {
        Model model = prism.model;
        for (std::size_t f = 0; f < faces; ++f) {
            if ((bits >> f) & 1U) flip_faces(model, {FaceId(f)});
        }
        orient_consistently(model);
        for (std::size_t e = 0; e < model.edges.size(); ++e) {
            const auto uses = model.uses_of_edge(EdgeId(e));
            CHECK(uses[0].reversed != uses[1].reversed);
        }
        CHECK(volume_integral(model, all) == doctest::Approx(prism.facet_volume));
        check_loops(model);
        ++combinations;
    }
    MESSAGE(combinations << " sets of turned faces");
}

TEST_CASE("turning a face over twice changes nothing, and its area vector turns with it")
{
    auto prism = test::prism({.sides = 5, .holes = 1, .target = End::bowed});
    for (std::size_t f = 0; f < prism.model.faces.size(); ++f) {
        const FaceId face(f);
        const Vec3 area = face_area_vector(prism.model, face);
        const auto loops = prism.model[face].loops;
        flip_faces(prism.model, {face});
        CHECK((face_area_vector(prism.model, face) + area).norm() == doctest::Approx(0));
        check_loops(prism.model);
        flip_faces(prism.model, {face});
        REQUIRE(prism.model[face].loops.size() == loops.size());
        for (std::size_t l = 0; l < loops.size(); ++l)
            CHECK(prism.model[face].loops[l].uses == loops[l].uses);
    }
}

TEST_CASE("a model made from another has the uses of its own edges and leaves the other as it was")
{
    const auto check_uses = [](const Model& model) {
        std::vector<std::vector<std::pair<FaceId, bool>>> uses(model.edges.size());
        for (const FaceId face : all_faces(model))
            for (const Loop& loop : model[face].loops)
                for (const EdgeUse& use : loop.uses) uses[use.edge.index()].emplace_back(face, use.reversed);
        for (std::size_t e = 0; e < uses.size(); ++e) {
            std::vector<std::pair<FaceId, bool>> kept;
            for (const FaceUse& use : model.uses_of_edge(EdgeId(e)))
                kept.emplace_back(use.face, use.reversed);
            CHECK((kept == uses[e]));
        }
    };
    static_assert(!std::is_convertible_v<ModelBuilder&, Model>); // a copy would change with the builder
    auto prism = test::prism({.sides = 5, .holes = 1});
    const Model before = prism.model;
    const FaceId wall = prism.face({Role::wall, 0, 0, 0, 0});
    const auto triangles = before[wall].triangles;
    check_uses(before);
    flip_faces(prism.model, {wall});
    check_uses(prism.model);
    CHECK(prism.model[wall].triangles != triangles);
    CHECK(before[wall].triangles == triangles);
    check_uses(before);

    ModelBuilder builder(before);
    const Model& unfinished = builder;
    CHECK_THROWS_AS(static_cast<void>(unfinished.uses_of_edge(EdgeId(0UL))), std::out_of_range);
    builder.faces.pop_back();
    const Model open = std::move(builder).finish();
    check_uses(open);
    CHECK(open.faces.size() + 1 == before.faces.size());
    Model moved = open;
    const Model taken = std::move(moved);
    CHECK(moved.faces.empty()); // NOLINT(bugprone-use-after-move)
    check_uses(taken);
}

TEST_CASE("a band with a half twist is refused, and the faces at the seam of the two directions are named")
{
    for (const int faces : {2, 3, 5}) {
        for (const int half_twists : {1, 2, 3}) {
            const int each = 24 / faces;
            const int columns = each * faces;
            healing::FacetSoup soup;
            for (int i = 0; i < columns; ++i) {
                const double u = 2 * std::numbers::pi * i / columns;
                for (const double v : {-0.3, 0.3}) {
                    const double turn = half_twists * u / 2;
                    const double r = 2 + v * std::cos(turn);
                    soup.points.emplace_back(r * std::cos(u), r * std::sin(u), v * std::sin(turn));
                }
            }
            for (Index i = 0; i < columns; ++i) {
                const bool crossed = i + 1 == columns && half_twists % 2 != 0;
                const Index a = 2 * i, b = a + 1, next = (i + 1) % columns * 2;
                const Index c = crossed ? next + 1 : next, d = crossed ? next : next + 1;
                soup.triangles.push_back({a, c, d});
                soup.triangles.push_back({a, d, b});
                soup.triangle_label.push_back(i / each);
                soup.triangle_label.push_back(i / each);
            }
            healing::SplitOptions split;
            split.whole_labels = true;
            Model model = healing::split_facets(soup, split);
            REQUIRE(model.faces.size() == static_cast<std::size_t>(faces));
            CAPTURE(faces);
            CAPTURE(half_twists);
            if (half_twists % 2 == 0) {
                CHECK_NOTHROW(orient_consistently(model));
                continue;
            }
            try {
                orient_consistently(model);
                FAIL("a one-sided band was oriented");
            } catch (const InvalidInput& error) {
                CHECK(error.code() == "topology.not_orientable");
                CHECK(std::string(error.what()).find("face ") != std::string::npos);
            }
        }
    }
}

TEST_CASE("an edge of three faces is refused, and edge and faces are named")
{
    healing::FacetSoup soup;
    soup.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}};
    for (Index i = 0; i < 3; ++i) {
        soup.triangles.push_back({0, 1, 2 + i});
        soup.triangle_label.push_back(i);
    }
    soup.label_name = {"left", "right", "fin"};
    Model model = healing::split_facets(soup);
    try {
        orient_consistently(model);
        FAIL("three faces at an edge were taken");
    } catch (const InvalidInput& error) {
        CHECK(error.code() == "topology.not_manifold");
        std::set<std::string> named;
        for (const NamedEntity& entity : error.message().entities())
            named.insert(entity.kind == "face" ? entity.name : entity.kind);
        CHECK(named == std::set<std::string>{"left", "right", "fin", "edge", "vertex"});
        CHECK(error.message().found() == std::vector<MessageValue>{3LL});
        CHECK(error.message().needed() == std::vector<MessageValue>{2LL});
    }
}

TEST_CASE("area, centroid and lengths move with the points")
{
    const auto prism = test::prism({.sides = 6, .holes = 2});
    const Eigen::AngleAxisd turn(1.1, Vec3(1, 2, 3).normalized());
    const Model other = test::moved(prism.model,
                                    [&](const Vec3& p) { return Vec3(turn * p * 3 + Vec3(5, -2, 7)); });
    for (std::size_t f = 0; f < prism.model.faces.size(); ++f) {
        const FaceId face(f);
        CHECK(face_area(other, face) == doctest::Approx(9 * face_area(prism.model, face)));
        CHECK((face_centroid(other, face) - (turn * face_centroid(prism.model, face) * 3 + Vec3(5, -2, 7)))
                  .norm() < 1e-12 * other.diagonal);
        CHECK((face_area_vector(other, face) - turn * face_area_vector(prism.model, face) * 9).norm() <
              1e-12 * other.diagonal * other.diagonal);
    }
    for (std::size_t e = 0; e < prism.model.edges.size(); ++e) {
        CHECK(edge_length(other, EdgeId(e)) == doctest::Approx(3 * edge_length(prism.model, EdgeId(e))));
    }
}
