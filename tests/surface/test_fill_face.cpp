// SPDX-License-Identifier: MIT
#include "support/edit_model.h"
#include <lacuna/core/error.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/quads/shared/pave.h>
#include <lacuna/surface/detail/fine_facets.h>
#include <lacuna/surface/shared/edge_nodes.h>
#include <lacuna/surface/shared/fill_face.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

using namespace lacuna;
using namespace lacuna::surface;

namespace {

/// z = a (x² - y²) / 2 + b (x² + y²) / 2, its parameters the plan.
class Graph final : public geometry::ExactSurface {
public:
    Graph(double a, double b) : p_(b + a), q_(b - a) {}
    [[nodiscard]] Vec3 at(const Vec2& uv) const
    {
        return {uv.x(), uv.y(), (p_ * uv.x() * uv.x() + q_ * uv.y() * uv.y()) / 2};
    }
    [[nodiscard]] Vec3 normal(const Vec2& uv) const
    {
        return Vec3(-p_ * uv.x(), -q_ * uv.y(), 1).normalized();
    }
    void project(std::span<Vec3> points, std::span<Vec2> uv, const RunContext& /*context*/) const override
    {
        for (std::size_t i = 0; i < points.size(); ++i) {
            for (int step = 0; step < 50; ++step) {
                const Vec3 miss = points[i] - at(uv[i]);
                const Vec3 du(1, 0, p_ * uv[i].x()), dv(0, 1, q_ * uv[i].y());
                Eigen::Matrix2d m;
                m << du.dot(du), du.dot(dv), du.dot(dv), dv.dot(dv);
                uv[i] += m.inverse() * Vec2(du.dot(miss), dv.dot(miss));
            }
            points[i] = at(uv[i]);
        }
    }

private:
    double p_, q_;
};

/// The graph over the unit circle.
class Rim final : public geometry::ExactCurve {
public:
    explicit Rim(std::shared_ptr<const Graph> graph) : graph_(std::move(graph)) {}
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& /*context*/) const override
    {
        for (std::size_t i = 0; i < params.size(); ++i)
            points[i] = graph_->at({std::cos(params[i]), std::sin(params[i])});
    }

private:
    std::shared_ptr<const Graph> graph_;
};

/// The graph over the unit disc as a face with four edges, in `rings` rings of `spokes` facets, exact or not.
struct Disc {
    std::shared_ptr<const Graph> graph;
    topology::Model model;

    Disc(double a, double b, int rings, int spokes, bool exact) : graph(std::make_shared<Graph>(a, b))
    {
        topology::ModelBuilder built;
        std::vector<Vec2> plan{Vec2(0, 0)};
        for (int r = 1; r <= rings; ++r) {
            for (int s = 0; s < spokes; ++s) {
                const double angle = 2 * std::numbers::pi * s / spokes;
                plan.push_back(Vec2(std::cos(angle), std::sin(angle)) * r / rings);
            }
        }
        const auto number = [&](int r, int s) { return r == 0 ? 0 : 1 + (r - 1) * spokes + s % spokes; };
        topology::Face face;
        face.tag = 1;
        for (int r = 0; r < rings; ++r) {
            for (int s = 0; s < spokes; ++s) {
                face.triangles.push_back({number(r, s), number(r + 1, s), number(r + 1, s + 1)});
                if (r > 0) face.triangles.push_back({number(r, s), number(r + 1, s + 1), number(r, s + 1)});
            }
        }
        for (const Vec2& p : plan) built.points.push_back(graph->at(p));
        if (exact) {
            face.surface = graph;
            for (const Triangle& t : face.triangles)
                face.uv.push_back(
                    {plan[std::size_t(t[0])], plan[std::size_t(t[1])], plan[std::size_t(t[2])]});
        }
        for (int e = 0; e < 4; ++e) {
            built.vertices.push_back({number(rings, e * spokes / 4), e + 1, topology::Origin::given});
            topology::Edge edge;
            edge.tag = e + 1;
            edge.from = VertexId(std::size_t(e));
            edge.to = VertexId(std::size_t((e + 1) % 4));
            for (int s = e * spokes / 4; s <= (e + 1) * spokes / 4; ++s) {
                edge.points.push_back(number(rings, s));
                if (exact) edge.params.push_back(2 * std::numbers::pi * s / spokes);
            }
            if (exact) edge.curve = std::make_shared<Rim>(graph);
            built.edges.push_back(std::move(edge));
        }
        built.faces.push_back(std::move(face));
        built.diagonal = 2 * std::numbers::sqrt2;
        built.tolerance = 1e-6;
        built.build_loops();
        model = std::move(built).finish();
    }
};

struct Filled {
    std::vector<RimNode> rim;
    FaceQuads quads;
};

Filled fill(const Disc& disc, double size)
{
    Filled filled;
    std::vector<std::vector<Index>> loops(1);
    for (const topology::EdgeUse& use : disc.model.faces[0].loops[0].uses) {
        const double length = topology::edge_length(disc.model, use.edge);
        const int sides = 2 * std::max(1, int(std::lround(length / size / 2)));
        std::vector<double> fractions;
        for (int k = 0; k < sides; ++k) fractions.push_back(double(use.reversed ? sides - k : k) / sides);
        const std::vector<Vec3> points = edge_points(disc.model, use.edge, fractions);
        for (std::size_t i = 0; i < points.size(); ++i) {
            loops[0].push_back(Index(filled.rim.size()));
            filled.rim.push_back({points[i], use.edge, fractions[i]});
        }
    }
    const auto paver = [](const quads::PlanarRegion& region, const RunContext& c) {
        return quads::pave(region, {}, c).mesh;
    };
    filled.quads = fill_face(disc.model, FaceId(0), filled.rim, loops, {[&](const Vec3&) { return size; }},
                             paver);
    return filled;
}

Vec3 corner(const Filled& filled, const Quad& quad, std::size_t k)
{
    return filled.quads.points[std::size_t(quad[k % 4])];
}

} // namespace

TEST_CASE("quads of a curved face lie on the exact surface, keep its rim and look outward")
{
    for (const double a : {0.0, 0.6, 1.2}) {
        for (const double b : {0.0, 0.5}) {
            for (const double size : {0.3, 0.08}) {
                CAPTURE(a);
                CAPTURE(b);
                CAPTURE(size);
                const Disc disc(a, b, 4, 24, true);
                const Filled filled = fill(disc, size);
                const std::vector<Vec3>& points = filled.quads.points;
                REQUIRE(points.size() > filled.rim.size());
                for (std::size_t p = 0; p < points.size(); ++p) {
                    if (p < filled.rim.size()) CHECK(points[p] == filled.rim[p].point);
                    const double z = disc.graph->at(points[p].head<2>()).z();
                    CHECK(std::abs(points[p].z() - z) < 1e-9);
                }
                CHECK(mesh::boundary_sides(filled.quads.quads).size() == filled.rim.size());
                std::size_t near_size = 0;
                for (const Quad& quad : filled.quads.quads) {
                    for (std::size_t k = 0; k < 4; ++k) {
                        const Vec3 here = corner(filled, quad, k), along = corner(filled, quad, k + 1) - here;
                        CHECK(along.cross(corner(filled, quad, k + 3) - here)
                                  .dot(disc.graph->normal(here.head<2>())) > 0);
                        if (along.norm() > 0.5 * size && along.norm() < 2 * size) ++near_size;
                    }
                }
                CHECK(double(near_size) > 0.92 * 4 * double(filled.quads.quads.size()));
            }
        }
    }
}

TEST_CASE("quads much finer than the facets stand in rows on the exact rim")
{
    // The chord of a rim facet misses the arc by more than half the size.
    const double size = 0.02;
    const Disc disc(0.8, 0, 3, 16, true);
    REQUIRE(1 - std::cos(std::numbers::pi / 16) > size / 2);
    const Filled filled = fill(disc, size);
    std::size_t rows = 0, good = 0;
    for (const Quad& quad : filled.quads.quads) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (std::size_t(quad[k]) >= filled.rim.size() ||
                std::size_t(quad[(k + 1) % 4]) >= filled.rim.size())
                continue;
            ++rows;
            const double left = (corner(filled, quad, k + 3) - corner(filled, quad, k)).norm();
            const double right = (corner(filled, quad, k + 2) - corner(filled, quad, k + 1)).norm();
            if (std::max(left, right) < 1.3 * size && std::min(left, right) > 0.7 * size) ++good;
        }
    }
    CHECK(rows >= filled.rim.size());
    CHECK(double(good) > 0.95 * double(rows));
}

TEST_CASE("fine facets follow the exact face as closely as asked, and plain facets stay")
{
    for (const double size : {0.5, 0.1, 0.02}) {
        CAPTURE(size);
        const Disc disc(1, 0.2, 3, 16, true);
        const FineFacets fine = fine_facets(disc.model, FaceId(0), [&](const Vec3&) { return size; });
        CHECK(fine.uv.size() == fine.triangles.size());
        for (const Triangle& t : fine.triangles) {
            Vec3 middle = Vec3::Zero();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &p = fine.points[std::size_t(t[k])], &q = fine.points[std::size_t(t[(k + 1) % 3])];
                CHECK(std::abs(p.z() - disc.graph->at(p.head<2>()).z()) < 1e-9);
                std::vector<Vec3> half{(p + q) / 2};
                std::vector<Vec2> uv{half[0].head<2>()};
                disc.graph->project(half, uv, {});
                CHECK((half[0] - (p + q) / 2).norm() < 0.0501 * size);
                middle += p / 3;
            }
            CHECK((fine.points[std::size_t(t[1])] - fine.points[std::size_t(t[0])])
                      .cross(fine.points[std::size_t(t[2])] - fine.points[std::size_t(t[0])])
                      .dot(disc.graph->normal(middle.head<2>())) > 0);
        }
        CHECK(fine.edges.size() == 4);
        for (const auto& [edge, chain] : fine.edges) {
            for (std::size_t i = 0; i < chain.size(); ++i) {
                const Vec3& p = fine.points[std::size_t(chain[i].point)];
                CHECK(p.head<2>().norm() == doctest::Approx(1));
                if (i == 0) continue;
                CHECK(chain[i].at > chain[i - 1].at);
                const Vec2 middle = (p + fine.points[std::size_t(chain[i - 1].point)]).head<2>() / 2;
                CHECK(1 - middle.norm() < 0.05 * size);
            }
        }
        const Disc plain(1, 0.2, 3, 16, false);
        const FineFacets same = fine_facets(plain.model, FaceId(0), [&](const Vec3&) { return size; });
        CHECK(same.triangles.size() == plain.model.faces[0].triangles.size());
    }
}

TEST_CASE("a curved face in two parts is refused by its name and with what to do, given or made")
{
    for (const bool made : {false, true}) {
        CAPTURE(made);
        Disc disc(0.4, 0.2, 4, 24, false);
        test::edit(disc.model, [made](topology::ModelBuilder& model) {
            const auto first = static_cast<Index>(model.points.size());
            for (const Vec3& p : {Vec3(5, 0, 0), Vec3(6, 0, 1), Vec3(5, 1, 0)}) model.points.push_back(p);
            topology::Face& face = model.faces[0];
            face.triangles.push_back({first, first + 1, first + 2});
            if (made) face.origin = topology::Origin::made_void;
        });
        try {
            fill(disc, 0.3);
            FAIL("filled");
        } catch (const InvalidInput& error) {
            CHECK(error.code() == "surface.not_flat");
            const Message& message = error.message();
            CHECK(message.entities() == std::vector<NamedEntity>{{made ? "void face" : "face", 1}});
            CHECK(message.remedy().starts_with(made ? "add the missing face" : "split it"));
            REQUIRE(message.attempts().size() == 1);
            CHECK(message.attempts().front().code() == "geometry.not_flattenable");
        }
    }
}
