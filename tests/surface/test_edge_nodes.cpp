// SPDX-License-Identifier: MIT
#include "surface/sealed.h"

#include <lacuna/surface/shared/edge_nodes.h>

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <numbers>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

bool same_bits(const Vec3& a, const Vec3& b)
{
    return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}

/// The unit circle about z, by angle.
class Circle final : public geometry::ExactCurve {
public:
    void evaluate(std::span<const double> params, std::span<Vec3> points,
                  const RunContext& /*context*/) const override
    {
        for (std::size_t i = 0; i < params.size(); ++i)
            points[i] = Vec3(std::cos(params[i]), std::sin(params[i]), 0);
    }
};

} // namespace

TEST_CASE(
    "points of an edge keep its ends to the bit, and lie on it in order at their fractions of its length")
{
    const auto prism = test::prism(
        {.sides = 5, .holes = 1, .hole_sides = 0, .cuts = 3, .levels = 5, .twist = 30, .bend = 30});
    const std::vector<double> fractions{-1, 0, 1e-17, 0.1, 0.25, 0.5, 0.9, 1 - 1e-17, 1, 2};
    for (std::size_t e = 0; e < prism.model.edges.size(); ++e) {
        const Edge& edge = prism.model.edges[e];
        const auto points = surface::edge_points(prism.model, EdgeId(e), fractions);
        REQUIRE(points.size() == fractions.size());
        for (const std::size_t i : {0, 1}) CHECK(same_bits(points[i], prism.model.at(edge.points.front())));
        for (const std::size_t i : {7, 8, 9}) CHECK(same_bits(points[i], prism.model.at(edge.points.back())));
        double run = 0, before = 0;
        std::size_t next = 3;
        const double length = edge_length(prism.model, EdgeId(e));
        for (std::size_t k = 0; k + 1 < edge.points.size(); ++k) {
            const Vec3 a = prism.model.at(edge.points[k]), b = prism.model.at(edge.points[k + 1]);
            before = run;
            run += (b - a).norm();
            for (; next < 7 && fractions[next] * length <= run; ++next) {
                const double f = (fractions[next] * length - before) / (b - a).norm();
                CHECK((points[next] - ((1 - f) * a + f * b)).norm() < 1e-12);
            }
        }
        CHECK(next == 7);
    }
}

TEST_CASE("points of an edge with an exact curve lie on the curve, not on the chords")
{
    ModelBuilder model;
    model.tolerance = 1e-9;
    model.diagonal = 2;
    Edge edge;
    for (int i = 0; i <= 6; ++i) {
        const double angle = std::numbers::pi * i / 6;
        edge.points.push_back(i);
        edge.params.push_back(angle);
        model.points.emplace_back(std::cos(angle), std::sin(angle), 0);
    }
    edge.curve = std::make_shared<Circle>();
    model.vertices = {{0, 1, Origin::given}, {6, 2, Origin::given}};
    edge.from = VertexId(std::size_t(0));
    edge.to = VertexId(std::size_t(1));
    model.edges.push_back(edge);
    std::vector<double> fractions;
    for (int i = 0; i <= 50; ++i) fractions.push_back(i / 50.0);
    const auto points = surface::edge_points(model, EdgeId(std::size_t(0)), fractions);
    for (std::size_t i = 0; i < points.size(); ++i) {
        CHECK(points[i].norm() == doctest::Approx(1).epsilon(1e-14));
        CHECK(std::atan2(points[i].y(), points[i].x()) ==
              doctest::Approx(std::numbers::pi * fractions[i]).epsilon(1e-9));
    }
    CHECK(same_bits(points.front(), model.points.front()));
    CHECK(same_bits(points.back(), model.points.back()));
    const std::vector<double> rounded{1e-15, 1 - 1e-15};
    const auto ends = surface::edge_points(model, EdgeId(std::size_t(0)), rounded);
    CHECK(same_bits(ends[0], model.points.front()));
    CHECK(same_bits(ends[1], model.points.back()));
}

TEST_CASE("a chain runs through its edges in the direction they are used, and its places and points agree")
{
    for (const int sides : {0, 3, 6}) {
        const auto volume = test::prism({.sides = sides, .pieces = 2}).open();
        for (const Role role : {Role::source, Role::target}) {
            for (const Rim& rim : rims(volume.model, volume.faces(role))) {
                const surface::Chain chain(volume.model, rim.uses);
                double sum = 0;
                for (std::size_t i = 0; i < rim.uses.size(); ++i) {
                    CHECK(chain.start(i) == doctest::Approx(sum));
                    sum += edge_length(volume.model, rim.uses[i].edge);
                    const std::vector<double> at{chain.start(i)};
                    CHECK((chain.points(at)[0] -
                           volume.model.at(volume.model[use_from(volume.model, rim.uses[i])].point))
                              .norm() < 1e-12);
                }
                CHECK(chain.length() == doctest::Approx(sum));
                std::vector<double> at;
                for (int k = 0; k <= 200; ++k) at.push_back(chain.length() * k / 200);
                const auto points = chain.points(at);
                for (std::size_t k = 0; k + 1 < at.size(); ++k) {
                    CHECK((points[k + 1] - points[k]).norm() <= (at[k + 1] - at[k]) * (1 + 1e-9));
                    const auto place = chain.position(at[k]);
                    CHECK(place.fraction >= 0);
                    CHECK(place.fraction <= 1);
                    const std::vector<double> f{place.fraction};
                    CHECK((surface::edge_points(volume.model, chain.uses()[place.use].edge, f)[0] - points[k])
                              .norm() < 1e-12);
                }
            }
        }
    }
}
