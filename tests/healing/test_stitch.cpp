// SPDX-License-Identifier: MIT
#include "support/dirt.h"
#include "support/edit_model.h"
#include "support/volumes.h"

#include <lacuna/core/error.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/healing/split_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>
#include <numeric>
#include <random>

using namespace lacuna;
using namespace lacuna::topology;
using test::append_loose;
using test::divide_edges;
using test::divide_sides;
using test::exploded;
using test::prism;
using test::shake;
using test::wobble;

namespace {

constexpr double kTolerance = 1e-4;
constexpr double pi = std::numbers::pi;

std::vector<std::size_t> uses_of(const Model& model)
{
    std::vector<std::size_t> uses;
    for (std::size_t e = 0; e < model.edges.size(); ++e) uses.push_back(model.uses_of_edge(EdgeId(e)).size());
    return uses;
}

/// What a stitched model must be, whatever it was before.
void check_whole(const Model& model)
{
    std::vector<bool> used(model.points.size(), false);
    for (const Edge& edge : model.edges) {
        CAPTURE(edge.tag);
        REQUIRE(edge.points.size() >= 2);
        CHECK(model[edge.from].point == edge.points.front());
        CHECK(model[edge.to].point == edge.points.back());
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) CHECK(edge.points[i] != edge.points[i + 1]);
        if (!edge.curve) continue;
        REQUIRE(edge.params.size() == edge.points.size());
        std::vector<Vec3> at(edge.params.size());
        edge.curve->evaluate(edge.params, at);
        for (std::size_t i = 0; i < at.size(); ++i)
            CHECK((at[i] - model.at(edge.points[i])).norm() <= 2 * kTolerance);
    }
    for (const Face& face : model.faces) {
        CAPTURE(face.tag);
        CHECK(!face.triangles.empty());
        std::map<std::pair<Index, Index>, int> halves;
        for (const Triangle& t : face.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                used[index(t[k])] = true;
                CHECK(++halves[{t[k], t[(k + 1) % 3]}] == 1);
            }
        }
        for (const Loop& loop : face.loops)
            for (std::size_t i = 0; i < loop.uses.size(); ++i)
                CHECK(use_to(model, loop.uses[i]) == use_from(model, loop.uses[(i + 1) % loop.uses.size()]));
    }
    CHECK(std::count(used.begin(), used.end(), false) == 0);
}

/// Every edge is used twice and the volume within is as given, once the faces face one way.
void check_closed(Model model, double volume, double error)
{
    check_whole(model);
    const std::vector<std::size_t> uses = uses_of(model);
    for (std::size_t e = 0; e < uses.size(); ++e) {
        CAPTURE(model.edges[e].tag);
        CHECK(uses[e] == 2);
    }
    orient_consistently(model);
    CHECK(std::abs(volume_integral(model, all_faces(model)) - volume) <= error);
}

std::vector<int> tags_of(const Model& model)
{
    std::vector<int> tags;
    for (const Face& face : model.faces) tags.push_back(face.tag);
    return tags;
}

double area_of(const Model& model)
{
    double sum = 0;
    for (const FaceId f : all_faces(model)) sum += face_area(model, f);
    return sum;
}

/// A circle about the z axis, or a part of one; the parameter is the angle.
class Circle final : public geometry::ExactCurve {
public:
    Circle(double radius, double z) : radius_(radius), z_(z) {}
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& /*context*/) const override
    {
        for (std::size_t i = 0; i < params.size(); ++i)
            points[i] = {radius_ * std::cos(params[i]), radius_ * std::sin(params[i]), z_};
    }

private:
    double radius_, z_;
};

/// A ring of `sides` points from angle `begin` on, cut into `arcs` edges.
std::vector<Index> add_ring(ModelBuilder& model, double radius, double z, int sides, int arcs, double begin)
{
    const auto circle = std::make_shared<Circle>(radius, z);
    std::vector<Index> ring;
    std::vector<double> angle;
    for (int i = 0; i < sides; ++i) {
        angle.push_back(begin + 2 * pi * i / sides);
        ring.push_back(static_cast<Index>(model.points.size()));
        model.points.push_back({radius * std::cos(angle.back()), radius * std::sin(angle.back()), z});
    }
    std::vector<VertexId> vertices;
    for (int k = 0; k < arcs; ++k) {
        vertices.emplace_back(model.vertices.size());
        model.vertices.push_back(
            {ring[index(k * sides / arcs)], static_cast<int>(model.vertices.size()) + 1});
    }
    for (int k = 0; k < arcs; ++k) {
        Edge edge;
        edge.tag = static_cast<int>(model.edges.size()) + 1;
        edge.from = vertices[index(k)];
        edge.to = vertices[index((k + 1) % arcs)];
        for (int i = k * sides / arcs; i <= (k + 1) * sides / arcs; ++i) {
            edge.points.push_back(ring[index(i % sides)]);
            edge.params.push_back(begin + 2 * pi * i / sides);
        }
        edge.curve = circle;
        model.edges.push_back(edge);
    }
    return ring;
}

void add_disc(Model& whole, double radius, double z, int sides, int arcs, double begin)
{
    ModelBuilder model(std::move(whole));
    const std::vector<Index> ring = add_ring(model, radius, z, sides, arcs, begin);
    const auto centre = static_cast<Index>(model.points.size());
    model.points.push_back({0, 0, z});
    Face face;
    face.tag = static_cast<int>(model.faces.size()) + 10;
    for (std::size_t i = 0; i < ring.size(); ++i)
        face.triangles.push_back({centre, ring[i], ring[(i + 1) % ring.size()]});
    model.faces.push_back(face);
    whole = std::move(model).finish();
}

/// A tube whose rims have as many sides as said.
void add_tube(Model& whole, double radius, double height, int sides, int arcs, double begin)
{
    ModelBuilder model(std::move(whole));
    const std::vector<Index> low = add_ring(model, radius, 0, sides, arcs, begin);
    const std::vector<Index> high = add_ring(model, radius, height, sides, arcs, begin);
    Face face;
    face.tag = static_cast<int>(model.faces.size()) + 10;
    for (std::size_t i = 0; i < low.size(); ++i) {
        const std::size_t k = (i + 1) % low.size();
        face.triangles.push_back({low[i], low[k], high[k]});
        face.triangles.push_back({low[i], high[k], high[i]});
    }
    model.faces.push_back(face);
    whole = std::move(model).finish();
}

/// A polygon in space as a face of its own: a fan, an edge a side (with `cuts` sides each).
void add_polygon(Model& whole, const std::vector<Vec3>& corners, int cuts = 1)
{
    ModelBuilder model(std::move(whole));
    Face face;
    face.tag = static_cast<int>(model.faces.size()) + 1;
    std::vector<Index> rim;
    std::vector<VertexId> vertices;
    const std::size_t n = corners.size();
    for (std::size_t i = 0; i < n; ++i) {
        vertices.emplace_back(model.vertices.size());
        model.vertices.push_back(
            {static_cast<Index>(model.points.size()), static_cast<int>(model.vertices.size()) + 1});
        for (int k = 0; k < cuts; ++k) {
            rim.push_back(static_cast<Index>(model.points.size()));
            model.points.push_back(corners[i] + (corners[(i + 1) % n] - corners[i]) * k / cuts);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        Edge edge;
        edge.tag = static_cast<int>(model.edges.size()) + 1;
        edge.from = vertices[i];
        edge.to = vertices[(i + 1) % n];
        for (std::size_t k = 0; k <= index(cuts); ++k)
            edge.points.push_back(rim[(i * index(cuts) + k) % rim.size()]);
        model.edges.push_back(edge);
    }
    const auto centre = static_cast<Index>(model.points.size());
    model.points.push_back(std::accumulate(corners.begin(), corners.end(), Vec3(0, 0, 0)) /
                           static_cast<double>(n));
    for (std::size_t i = 0; i < rim.size(); ++i)
        face.triangles.push_back({centre, rim[i], rim[(i + 1) % rim.size()]});
    model.faces.push_back(face);
    whole = std::move(model).finish();
}

/// The six faces of a box, loose.
void add_box(Model& model, const Vec3& low, const Vec3& high, int cuts = 1)
{
    const auto at = [&](int x, int y, int z) {
        return Vec3(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
    };
    add_polygon(model, {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}, cuts);
    add_polygon(model, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, cuts);
    add_polygon(model, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, cuts);
    add_polygon(model, {at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)}, cuts);
    add_polygon(model, {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, cuts);
    add_polygon(model, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}, cuts);
}

/// n × n cells on the patch o + u s + v t, with points of its own.
void add_patch(healing::FacetSoup& soup, int n, const Vec3& o, const Vec3& u, const Vec3& v, bool quads)
{
    const auto first = static_cast<Index>(soup.points.size());
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) soup.points.push_back(o + u * i / n + v * j / n);
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const Index a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
            if (quads) {
                soup.quads.push_back({a, b, c, d});
            } else {
                soup.triangles.push_back({a, b, c});
                soup.triangles.push_back({a, c, d});
            }
        }
    }
}

/// A unit square of n × n quads, which are a mesh to be kept or just facets.
void add_grid(Model& whole, const Vec3& corner, int n, bool keep)
{
    ModelBuilder model(std::move(whole));
    const auto first = static_cast<Index>(model.points.size());
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
            model.points.push_back(corner + Vec3(static_cast<double>(i) / n, static_cast<double>(j) / n, 0));
    Face face;
    face.tag = static_cast<int>(model.faces.size()) + 1;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const Index a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
            face.triangles.push_back({a, b, c});
            face.triangles.push_back({a, c, d});
            if (keep) face.given_quads.push_back({a, b, c, d});
        }
    }
    model.faces.push_back(face);
    const std::array<Index, 4> corners{first, first + n, first + (n + 2) * n, first + (n + 1) * n};
    const std::array<Index, 4> step{1, n + 1, -1, -(n + 1)};
    const std::size_t vertices = model.vertices.size();
    for (const Index c : corners) model.vertices.push_back({c, static_cast<int>(model.vertices.size()) + 1});
    for (std::size_t k = 0; k < 4; ++k) {
        Edge edge;
        edge.tag = static_cast<int>(model.edges.size()) + 1;
        edge.from = VertexId(vertices + k);
        edge.to = VertexId(vertices + (k + 1) % 4);
        for (int i = 0; i <= n; ++i) edge.points.push_back(corners[k] + i * step[k]);
        model.edges.push_back(edge);
    }
    whole = std::move(model).finish();
}

/// The closed solids of the tests, as models whose faces share their edges.
std::vector<test::PrismOptions> solids()
{
    return {{},
            {.sides = 3, .cuts = 3},
            {.sides = 6, .rows = 2},
            {.sides = 0},
            {.sides = 5, .pieces = 2},
            {.sides = 4, .holes = 1},
            {.sides = 0, .holes = 2, .hole_sides = 0},
            {.sides = 4, .twist = 30},
            {.sides = 6, .bend = 60},
            {.sides = 4, .target = test::End::bowed}};
}

} // namespace

TEST_CASE("loose faces become the closed skin they came from, whatever was done to them below the tolerance")
{
    for (std::size_t s = 0; s < solids().size(); ++s) {
        const test::Prism solid = prism(solids()[s]);
        for (unsigned dirt = 0; dirt < 16; ++dirt) {
            CAPTURE(s);
            CAPTURE(dirt);
            Model model = exploded(solid.model);
            if ((dirt & 1U) != 0) divide_sides(model, dirt + 7);
            if ((dirt & 2U) != 0) divide_edges(model, 3);
            if ((dirt & 4U) != 0) shake(model, 0.45 * kTolerance, dirt);
            if ((dirt & 8U) != 0) flip_faces(model, {FaceId(0UL), FaceId(2UL)});
            const std::vector<int> tags = tags_of(model);
            const healing::StitchReport report = healing::stitch(model, kTolerance);
            CHECK(report.changed());
            for (const Message& note : report.notes) MESSAGE(note.text());
            CHECK(report.notes.empty());
            CHECK(tags_of(model) == tags);
            check_closed(model, solid.facet_volume, 2 * kTolerance * area_of(model));
            if ((dirt & 2U) == 0) {
                CHECK(model.edges.size() == solid.model.edges.size());
                CHECK(model.vertices.size() == solid.model.vertices.size());
            }
        }
    }
}

TEST_CASE("stitching twice is stitching once, and a whole skin stays as it is to the bit")
{
    for (std::size_t s = 0; s < solids().size(); ++s) {
        CAPTURE(s);
        Model whole = prism(solids()[s]).model;
        const Model before = whole;
        CHECK(!healing::stitch(whole, kTolerance).changed());
        CHECK(whole.points == before.points);
        Model model = exploded(before);
        divide_sides(model, 5);
        divide_edges(model, 4);
        shake(model, 0.4 * kTolerance, 3);
        Model twin = model;
        healing::stitch(model, kTolerance);
        healing::stitch(twin, kTolerance);
        CHECK(twin.points == model.points);
        for (std::size_t f = 0; f < model.faces.size(); ++f)
            CHECK(twin.faces[f].triangles == model.faces[f].triangles);
        CHECK(!healing::stitch(twin, kTolerance).changed());
        CHECK(twin.points == model.points);
    }
}

TEST_CASE("circles divided differently, begun elsewhere or in arcs share their points, all on the circle")
{
    for (const int sides : {12, 36, 50, 97}) {
        for (const int arcs : {1, 2, 3}) {
            for (const double turn : {0.0, 0.3, 2.0}) {
                CAPTURE(sides);
                CAPTURE(arcs);
                CAPTURE(turn);
                Model model;
                add_disc(model, 1, 0, sides, 1, turn);
                add_disc(model, 1, 2, 48, arcs, 0);
                add_tube(model, 1, 2, 36, 1, 0);
                shake(model, 0.4 * kTolerance, 1);
                model = with_loops(model);
                const healing::StitchReport report = healing::stitch(model, kTolerance);
                CHECK(report.notes.empty());
                const double least = sides == 12 ? 24 : 36; // no coarser than the finest side needs
                const double polygon = 2 * (least / 2) * std::sin(2 * pi / least);
                check_closed(model, (2 * pi + polygon) / 2, (2 * pi - polygon) / 2 + 1e-3);
                for (const Edge& edge : model.edges) CHECK(edge.curve != nullptr);
            }
        }
    }
}

TEST_CASE("a closed polyline without a corner begins at the vertex found on it")
{
    for (const int shift : {0, 1, 7}) {
        CAPTURE(shift);
        Model model;
        add_disc(model, 1, 0, 24, 1, 2 * pi * shift / 24);
        add_disc(model, 1, 2, 24, 1, -2 * pi * shift / 24);
        add_tube(model, 1, 2, 24, 1, 0);
        test::edit(model, [](ModelBuilder& plain) {
            for (Edge& edge : plain.edges) {
                edge.curve = nullptr;
                edge.params.clear();
            }
        });
        model = with_loops(model);
        CHECK(healing::stitch(model, kTolerance).notes.empty());
        check_closed(model, 24 * std::sin(2 * pi / 24), 1e-9);
        CHECK(model.edges.size() == 2);
        CHECK(model.vertices.size() == 2);
    }
}

TEST_CASE("edges that part between their ends merge below the tolerance and stay with a note above it")
{
    for (const double part : {0.5, 0.9, 1.5, 100.0}) {
        CAPTURE(part);
        Model model;
        add_polygon(model, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 4);
        add_polygon(model, {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}, 4);
        // The last edge of the second face bows away from the first.
        test::edit(model, [&](ModelBuilder& bowed) {
            for (std::size_t i = 1; i < 4; ++i)
                bowed.points[index(bowed.edges[7].points[i])].x() += part * kTolerance;
        });
        model = with_loops(model);
        const healing::StitchReport report = healing::stitch(model, kTolerance);
        check_whole(model);
        const std::vector<std::size_t> uses = uses_of(model);
        CHECK(model.vertices.size() == 6);
        if (part < 1) {
            CHECK(std::count(uses.begin(), uses.end(), 2U) == 1);
            CHECK(report.notes.empty());
        } else {
            CHECK(std::count(uses.begin(), uses.end(), 2U) == 0);
            REQUIRE(report.notes.size() == 1);
            CHECK(report.notes[0].text().find("edge 2 of face 1") != std::string::npos);
            CHECK(report.notes[0].text().find("edge 8 of face 2") != std::string::npos);
            CHECK(report.notes[0].text().find("a gap of") != std::string::npos);
        }
    }
}

TEST_CASE("a side shared by one face here and several there is split where they meet")
{
    for (const int pieces : {2, 3, 7}) {
        for (const int cuts : {1, 2, 5}) {
            CAPTURE(pieces);
            CAPTURE(cuts);
            Model model;
            add_box(model, {0, 0, 0}, {1, 2, 1}, cuts);
            // The front comes in strips.
            const auto front = static_cast<std::ptrdiff_t>(2);
            Model others;
            for (std::size_t f = 0; f < 6; ++f) {
                model = with_loops(model);
                if (static_cast<std::ptrdiff_t>(f) != front) append_loose(others, model, {FaceId(f)});
            }
            for (int k = 0; k < pieces; ++k) {
                const double a = static_cast<double>(k) / pieces, b = static_cast<double>(k + 1) / pieces;
                add_polygon(others, {{a, 0, 0}, {b, 0, 0}, {b, 0, 1}, {a, 0, 1}}, cuts + k);
            }
            shake(others, 0.4 * kTolerance, 4);
            others = with_loops(others);
            const healing::StitchReport report = healing::stitch(others, kTolerance);
            CHECK(report.edges_split == 2);
            CHECK(report.notes.empty());
            check_closed(others, 2, 10 * kTolerance);
            CHECK(others.edges.size() == std::size_t(12 + 3 * (pieces - 1)));
        }
    }
}

TEST_CASE("edges no longer than the tolerance become vertices, and faces no wider go with a note")
{
    Model corner;
    add_box(corner, {0, 0, 0}, {1, 1, 1}, 3);
    Model model;
    corner = with_loops(corner);
    append_loose(model, corner, {FaceId(0UL), FaceId(2UL), FaceId(3UL), FaceId(4UL), FaceId(5UL)});
    const double e = kTolerance / 2;
    add_polygon(model, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {1 - e, 1, 1}, {0, 1, 1}}, 3);
    model = with_loops(model);
    healing::StitchReport report = healing::stitch(model, kTolerance);
    CHECK(report.edges_collapsed == 1);
    check_closed(model, 1, 10 * kTolerance);
    CHECK(model.edges.size() == 12);

    Model strip;
    add_polygon(strip, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 5);
    add_polygon(strip, {{1, 0, 0}, {1 + e, 0, 0}, {1 + e, 1, 0}, {1, 1, 0}}, 3);
    add_polygon(strip, {{1 + e, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1 + e, 1, 0}}, 2);
    strip = with_loops(strip);
    report = healing::stitch(strip, kTolerance);
    check_whole(strip);
    CHECK(report.faces_left_out == 1);
    REQUIRE(report.notes.size() == 1);
    CHECK(report.notes[0].text().find("face 2") != std::string::npos);
    CHECK(tags_of(strip) == std::vector<int>{1, 3});
    const std::vector<std::size_t> uses = uses_of(strip);
    CHECK(std::count(uses.begin(), uses.end(), 2U) == 1);
    CHECK(std::count(uses.begin(), uses.end(), 1U) == 6);
}

TEST_CASE(
    "a face listed twice stays once, named; skins a gap apart and solids that touch keep all their faces")
{
    for (std::size_t s = 0; s < solids().size(); ++s) {
        const test::Prism solid = prism(solids()[s]);
        for (std::size_t f = 0; f < solid.model.faces.size(); ++f) {
            CAPTURE(s);
            CAPTURE(f);
            Model model = exploded(solid.model);
            append_loose(model, solid.model, {FaceId(f)});
            test::edit(model, [](ModelBuilder& tagged) { tagged.faces.back().tag = 777; });
            if (f % 2 == 0) flip_faces(model, {FaceId(model.faces.size() - 1)});
            shake(model, 0.4 * kTolerance, static_cast<unsigned>(f));
            const healing::StitchReport report = healing::stitch(model, kTolerance);
            CHECK(report.faces_left_out == 1);
            REQUIRE(report.notes.size() == 1);
            CHECK(report.notes[0].text().find("face 777") != std::string::npos);
            CHECK(report.notes[0].text().find("face " + std::to_string(solid.model.faces[f].tag)) !=
                  std::string::npos);
            CHECK(tags_of(model) == tags_of(solid.model));
            check_closed(model, solid.facet_volume, 2 * kTolerance * area_of(model));
        }
    }
    // The whole solid twice, then with a gap, then side by side.
    for (const double gap : {0.0, 3 * kTolerance, 1.0}) {
        CAPTURE(gap);
        Model model;
        add_box(model, {0, 0, 0}, {1, 1, 1}, 2);
        const Vec3 away = gap == 1 ? Vec3(1, 0, 0) : Vec3(gap, gap, gap);
        add_box(model, away, away + Vec3(1, 1, 1), 2);
        model = with_loops(model);
        const healing::StitchReport report = healing::stitch(model, kTolerance);
        check_whole(model);
        CHECK(report.faces_left_out == (gap == 0 ? 6 : 0));
        CHECK(model.faces.size() == (gap == 0 ? 6U : 12U));
        std::vector<std::size_t> uses = uses_of(model);
        CHECK(std::count(uses.begin(), uses.end(), 4U) == (gap == 1 ? 4 : 0));
        CHECK(std::count(uses.begin(), uses.end(), 1U) == 0);
    }
}

TEST_CASE("a facet side inside a face does not pass for another face's edge between the same two vertices")
{
    Model model;
    // Two facets of a face meet along a diagonal, a triangle of another face stands on it.
    const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0), top(0.5, 0.5, 1);
    add_polygon(model, {a, b, c, d});
    test::edit(model, [](ModelBuilder& halves) {
        halves.points.pop_back(); // the fan's centre
        halves.faces[0].triangles = {{0, 1, 2}, {0, 2, 3}};
    });
    add_polygon(model, {a, c, top});
    model = with_loops(model);
    healing::stitch(model, kTolerance);
    check_whole(model);
    REQUIRE(model.faces[0].loops.size() == 1);
    CHECK(model.faces[0].loops[0].uses.size() == 4);
    CHECK(model.vertices.size() == 5);
}

TEST_CASE("nodes of a mesh that is kept stay to the bit and get no others between them")
{
    for (const int nodes : {1, 2, 3, 6}) {
        for (const bool both : {true, false}) {
            CAPTURE(nodes);
            CAPTURE(both);
            Model model;
            add_grid(model, {0, 0, 0}, nodes, both); // met first
            add_grid(model, {1, 0, 0}, 3, true);
            shake(model, 0.4 * kTolerance, 9);
            model = with_loops(model);
            std::vector<Vec3> kept;
            for (std::size_t f = both ? 0 : 1; f < 2; ++f)
                for (const Quad& q : model.faces[f].given_quads)
                    for (const Index p : q) kept.push_back(model.at(p));
            const std::size_t quads = model.faces[0].given_quads.size() + model.faces[1].given_quads.size();
            const healing::StitchReport report = healing::stitch(model, kTolerance);
            check_whole(model);
            // Nodes between the kept ones have no place; fewer are filled up where the face has no mesh of
            // its own.
            const bool fits = nodes == 3 || (!both && nodes == 1);
            CHECK(report.edges_merged == (fits ? 1 : 0));
            CHECK(report.notes.size() == (fits ? 0U : 1U));
            if (!fits) CHECK(report.notes[0].text().find("keep_mesh = false") != std::string::npos);
            CHECK(model.faces[0].given_quads.size() + model.faces[1].given_quads.size() == quads);
            if (both) continue; // of two kept nodes one must give way, by less than the tolerance
            for (const Vec3& node : kept)
                CHECK(std::find(model.points.begin(), model.points.end(), node) != model.points.end());
        }
    }
}

TEST_CASE(
    "facets with points on the inside of their sides are cut there, so the skin is whole; given quads stay")
{
    for (const bool quads : {false, true}) {
        for (const int n : {1, 2, 5}) {
            CAPTURE(quads);
            CAPTURE(n);
            healing::FacetSoup soup;
            const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
            // Every side of the cube is divided in a way of its own; in one part, so that all is within a
            // label.
            std::mt19937 random(static_cast<unsigned>(n));
            add_patch(soup, 1, o, y, x, false);
            add_patch(soup, n, z, x, y, quads);
            add_patch(soup, 1, o, x, z, false);
            add_patch(soup, 1, y, z, x, false);
            add_patch(soup, n > 1 && !quads ? n + 1 : 1, o, z, y, false);
            add_patch(soup, 1, x, y, z, false);
            for (Vec3& p : soup.points) p += 0.4 * kTolerance * wobble(random);
            const Model model = healing::split_facets(soup, {.tolerance = kTolerance});
            check_closed(model, 1, 10 * kTolerance);
            CHECK(model.faces.size() == 6);
            CHECK(model.edges.size() == 12);
            std::size_t kept = 0;
            for (const Face& face : model.faces) kept += face.given_quads.size();
            CHECK(kept == (quads ? index(n * n) : 0U));
        }
    }
}

TEST_CASE("facets listed twice in a part come once, with a note; in two parts they are one face each")
{
    for (const bool quads : {false, true}) {
        for (const bool turned : {false, true}) {
            CAPTURE(quads);
            CAPTURE(turned);
            healing::FacetSoup soup;
            const Vec3 x(1, 0, 0), y(0, 1, 0), o(0, 0, 0);
            add_patch(soup, 3, o, x, y, quads);
            add_patch(soup, 3, turned ? o : Vec3(0, 0, kTolerance / 2), turned ? y : x, turned ? x : y,
                      quads);
            const Model model = healing::split_facets(soup, {.tolerance = kTolerance});
            CHECK(model.faces.size() == 1);
            CHECK(face_area(model, FaceId(0UL)) == doctest::Approx(1));
            REQUIRE(model.notes.size() == 1);
            CHECK(model.notes[0].text().find("18 facets") == 0);
            if (quads) CHECK(model.faces[0].given_quads.size() == 9);
            auto& label = quads ? soup.quad_label : soup.triangle_label;
            label.assign(quads ? 18 : 36, 0);
            std::fill(label.begin() + static_cast<std::ptrdiff_t>(label.size() / 2), label.end(), 1);
            Model parts = healing::split_facets(soup, {.tolerance = kTolerance});
            CHECK(parts.faces.size() == 2);
            CHECK(parts.notes.empty());
            const healing::StitchReport report = healing::stitch(parts, kTolerance);
            CHECK(parts.faces.size() == 1);
            CHECK(report.notes.size() == 1);
        }
    }
}

TEST_CASE("a thousand loose faces are stitched in well under a second")
{
    Model model;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j)
            for (int k = 0; k < 5; ++k)
                add_box(model, Vec3(i, j, k) * 1.5, Vec3(i, j, k) * 1.5 + Vec3(1, 1, 1), 8);
    shake(model, 0.4 * kTolerance, 2);
    model = with_loops(model);
    const std::clock_t start = std::clock();
    healing::stitch(model, kTolerance);
    const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    MESSAGE(taken << " s for " << model.faces.size() << " faces");
    CHECK(taken < 2); // on a machine that is busy
    check_closed(model, 180, 1);
}

TEST_CASE("a tolerance that is none is refused")
{
    Model model = prism().model;
    CHECK_THROWS_AS(healing::stitch(model, 0), InvalidInput);
    CHECK_THROWS_AS(healing::stitch(model, -1), InvalidInput);
}
