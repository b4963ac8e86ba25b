// SPDX-License-Identifier: MIT
#include "support/mixed_cells.h"

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/quality/shared/prove_cells.h>
#include <lacuna/quality/shared/second_order.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <map>
#include <random>

using namespace lacuna;

namespace {

const Hex kTet{0, 1, 2, 2, 3, 3, 3, 3}, kPyramid{0, 1, 2, 3, 4, 4, 4, 4}, kWedge{0, 1, 2, 2, 3, 4, 5, 5};

std::vector<Vec3> even_pyramid(double height = std::sqrt(0.5))
{
    return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, height}};
}
std::vector<Vec3> even_tet()
{
    return {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}, {0.5, std::sqrt(1 / 12.0), std::sqrt(2 / 3.0)}};
}
std::vector<Vec3> even_wedge()
{
    const double h = std::sqrt(0.75);
    return {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}};
}

quality::Quality measured(const std::vector<Vec3>& nodes, const Hex& cell)
{
    return quality::measure_cells(nodes, std::vector<Hex>{cell});
}

/// A shape of order 2: corners as in `Hex`, edges, and shape functions of textbooks, corners first.
struct Shape {
    Hex cell;
    std::vector<Vec3> corners;
    std::vector<Segment> edges;
    /// Values at a point of the shape's own space, given by three numbers of [0, 1].
    std::function<std::vector<double>(const Vec3&)> values;
    /// The point for three numbers of [0, 1), not at the apex.
    std::function<Vec3(const Vec3&)> inside;
    bool has_centre = false; ///< of the base, the last node
};

std::vector<double> tet_values(const Vec3& p)
{
    const double l[4] = {1 - p.x() - p.y() - p.z(), p.x(), p.y(), p.z()};
    std::vector<double> n;
    for (const double a : l) n.push_back(a * (2 * a - 1));
    for (const auto& [a, b] : {std::pair(0, 1), {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}})
        n.push_back(4 * l[a] * l[b]);
    return n;
}

std::vector<double> wedge_values(const Vec3& p)
{
    const double l[3] = {1 - p.x() - p.y(), p.x(), p.y()}, z = 2 * p.z() - 1;
    std::vector<double> n;
    for (const double s : {-1.0, 1.0})
        for (const double a : l) n.push_back(a * (2 * a - 1) * (1 + s * z) / 2 - a * (1 - z * z) / 2);
    for (const double s : {-1.0, 1.0})
        for (int k = 0; k < 3; ++k) n.push_back(2 * l[k] * l[(k + 1) % 3] * (1 + s * z));
    for (const double a : l) n.push_back(a * (1 - z * z));
    return n;
}

/// Bedrosian's pyramid of 13 nodes, base [-1, 1]².
std::vector<double> pyramid_values(const Vec3& p)
{
    const double x = p.x(), y = p.y(), z = p.z(), t = 1 - z;
    std::vector<double> n;
    constexpr double kX[] = {-1, 1, 1, -1}, kY[] = {-1, -1, 1, 1};
    for (int k = 0; k < 4; ++k)
        n.push_back((t + kX[k] * x) * (t + kY[k] * y) * (kX[k] * x + kY[k] * y - 1) / (4 * t));
    n.push_back(z * (2 * z - 1));
    n.push_back((t * t - x * x) * (t - y) / (2 * t));
    n.push_back((t * t - y * y) * (t + x) / (2 * t));
    n.push_back((t * t - x * x) * (t + y) / (2 * t));
    n.push_back((t * t - y * y) * (t - x) / (2 * t));
    for (int k = 0; k < 4; ++k) n.push_back(z * (t + kX[k] * x) * (t + kY[k] * y) / t);
    return n;
}

/// The same with a node in the centre of the base, whose bubble is taken from the others.
std::vector<double> full_pyramid_values(const Vec3& p)
{
    const double x = p.x(), y = p.y(), t = 1 - p.z(), centre = (t * t - x * x) * (t * t - y * y) / (t * t);
    std::vector<double> n = pyramid_values(p);
    for (std::size_t k = 0; k < 4; ++k) {
        n[k] += centre / 4;
        n[5 + k] -= centre / 2;
    }
    n.push_back(centre);
    return n;
}

std::vector<Shape> shapes()
{
    const auto in_pyramid = [](const Vec3& p) -> Vec3 {
        return {(2 * p.x() - 1) * (1 - p.z()), (2 * p.y() - 1) * (1 - p.z()), p.z()};
    };
    const std::vector<Segment> of_pyramid{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}};
    return {{kTet,
             even_tet(),
             {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
             tet_values,
             [](const Vec3& p) -> Vec3 {
                 return {p.x() * (1 - p.y()) * (1 - p.z()), p.y() * (1 - p.z()), p.z()};
             }},
            {kWedge,
             even_wedge(),
             {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
             wedge_values,
             [](const Vec3& p) -> Vec3 {
                 return {p.x() * (1 - p.y()), p.y(), p.z()};
             }},
            {kPyramid, even_pyramid(), of_pyramid, pyramid_values, in_pyramid},
            {kPyramid, even_pyramid(), of_pyramid, full_pyramid_values, in_pyramid, true}};
}

/// The Jacobian of a shape at a point, by differences that are exact up to rounding for its polynomials.
double jacobian(const Shape& shape, const std::vector<Vec3>& nodes, const Vec3& at)
{
    constexpr double h = 1e-4;
    Eigen::Matrix3d d = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) {
        Vec3 high = at, low = at;
        high[k] += h;
        low[k] -= h;
        const std::vector<double> a = shape.values(high), b = shape.values(low);
        for (std::size_t n = 0; n < nodes.size(); ++n) d.col(k) += (a[n] - b[n]) / (2 * h) * nodes[n];
    }
    return d.determinant();
}

/// The cell with twenty nodes or 21, as `measure_cells()` takes it.
quality::Quality measured_second(const Shape& shape, const std::vector<Vec3>& nodes)
{
    mesh::CellNodes cell;
    for (const Index corner : shape.cell) cell.node[cell.count++] = corner;
    for (const auto& [from, to] : mesh::kHexEdges) {
        const Index a = shape.cell[index(from)], b = shape.cell[index(to)];
        const auto edge = std::ranges::find_if(shape.edges, [&](const Segment& of) {
            return of == Segment{a, b} || of == Segment{b, a};
        });
        cell.node[cell.count++] = a == b ? a
                                         : static_cast<Index>(shape.corners.size()) +
                                               static_cast<Index>(edge - shape.edges.begin());
    }
    if (shape.has_centre) cell.node[cell.count++] = static_cast<Index>(nodes.size()) - 1;
    return quality::measure_cells(nodes, std::vector<mesh::CellNodes>{cell});
}

std::vector<Vec3> with_middles(const Shape& shape, double bend, std::mt19937& random)
{
    std::normal_distribution<double> move(0, 1);
    std::vector<Vec3> nodes = shape.corners;
    for (const auto& [a, b] : shape.edges)
        nodes.push_back((nodes[index(a)] + nodes[index(b)]) / 2 +
                        bend * Vec3(move(random), move(random), move(random)));
    if (!shape.has_centre) return nodes;
    Vec3 centre = bend * Vec3(move(random), move(random), move(random));
    for (std::size_t k = 0; k < 4; ++k) centre += nodes[5 + k] / 2 - nodes[k] / 4;
    nodes.push_back(centre);
    return nodes;
}

} // namespace

TEST_CASE(
    "pyramids and tetrahedra of equal sides have scaled Jacobian 1 and their volumes; folded ones do not")
{
    const auto pyramid = measured(even_pyramid(), kPyramid), tet = measured(even_tet(), kTet);
    CHECK(pyramid.pyramids == 1);
    CHECK(pyramid.hexes + pyramid.wedges + pyramid.tets == 0);
    CHECK(pyramid.min_scaled_jacobian == doctest::Approx(1));
    CHECK(pyramid.volume == doctest::Approx(std::sqrt(0.5) / 3));
    CHECK(tet.tets == 1);
    CHECK(tet.hexes + tet.wedges + tet.pyramids == 0);
    CHECK(tet.min_scaled_jacobian == doctest::Approx(1));
    CHECK(tet.volume == doctest::Approx(std::sqrt(2) / 12));
    CHECK(measured(even_pyramid(3), kPyramid).min_scaled_jacobian == 1);
    CHECK(measured(even_pyramid(0.1), kPyramid).min_scaled_jacobian < 0.3);
    for (const auto& [nodes, cell] : {std::pair(even_pyramid(), kPyramid), std::pair(even_tet(), kTet)}) {
        CHECK(measured(nodes, cell).uncertified == 0);
        auto folded = nodes;
        folded.back().z() *= -1;
        CHECK(measured(folded, cell).min_scaled_jacobian < 0);
        CHECK(measured(folded, cell).uncertified == 1);
        folded.back().z() = 0;
        CHECK(measured(folded, cell).uncertified == 1);
        folded.back().z() = std::numeric_limits<double>::quiet_NaN();
        CHECK(measured(folded, cell).uncertified == 1);
    }
}

TEST_CASE("a pyramid is certified exactly where its Jacobian is positive everywhere")
{
    std::mt19937 random(3);
    std::normal_distribution<double> move(0, 0.25);
    int certified = 0, refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::vector<Vec3> c = even_pyramid();
        for (Vec3& p : c) p += Vec3(move(random), move(random), move(random));
        double least = kInfinity;
        constexpr int n = 10;
        for (int u = 0; u <= n; ++u)
            for (int v = 0; v <= n; ++v)
                for (const double w : {0.0, 0.3, 0.9}) {
                    const double x = double(u) / n, y = double(v) / n;
                    const Vec3 base = (1 - x) * (1 - y) * c[0] + x * (1 - y) * c[1] + x * y * c[2] +
                                      (1 - x) * y * c[3];
                    const Vec3 along_u = (1 - w) * ((1 - y) * (c[1] - c[0]) + y * (c[2] - c[3]));
                    const Vec3 along_v = (1 - w) * ((1 - x) * (c[3] - c[0]) + x * (c[2] - c[1]));
                    least = std::min(least, along_u.dot(along_v.cross(c[4] - base)));
                }
        const bool is_certified = measured(c, kPyramid).uncertified == 0;
        CHECK(is_certified == (least > 0));
        ++(is_certified ? certified : refused);
    }
    CHECK(certified > 100);
    CHECK(refused > 100);
}

TEST_CASE("curved cells are certified only where their Jacobian is positive at every sample, and mostly "
          "where it is")
{
    std::mt19937 random(5);
    for (const Shape& shape : shapes()) {
        CAPTURE(shape.corners.size());
        int certified = 0, positive = 0;
        for (int i = 0; i < 300; ++i) {
            const std::vector<Vec3> nodes = with_middles(shape, 0.02 + 0.12 * (i % 10) / 10, random);
            double least = kInfinity;
            constexpr int n = 8;
            for (int u = 0; u <= n; ++u)
                for (int v = 0; v <= n; ++v)
                    for (int w = 0; w <= n; ++w) {
                        const Vec3 at = shape.inside({double(u) / n, double(v) / n, 0.998 * w / n});
                        least = std::min(least, jacobian(shape, nodes, at));
                    }
            const quality::Quality quality = measured_second(shape, nodes);
            CHECK((quality.uncertified > 0 || least > -1e-6));
            certified += quality.uncertified == 0;
            positive += least > 0;
        }
        MESSAGE(shape.corners.size() << " corners: " << certified << " certified of " << positive
                                     << " positive at all samples");
        CHECK(positive > 50);
        CHECK(positive < 290);
        CHECK(certified >= 0.9 * positive);
    }
}

TEST_CASE("curved cells have the volume of their map, straight ones the values of order 1")
{
    std::mt19937 random(7);
    constexpr double kGauss[5] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                  0.953089922969332};
    constexpr double kWeight[5] = {0.118463442528095, 0.239314335249683, 0.284444444444444, 0.239314335249683,
                                   0.118463442528095};
    for (const Shape& shape : shapes()) {
        CAPTURE(shape.corners.size());
        const std::vector<Vec3> nodes = with_middles(shape, 0.05, random);
        double volume = 0;
        for (int u = 0; u < 5; ++u)
            for (int v = 0; v < 5; ++v)
                for (int w = 0; w < 5; ++w) {
                    const Vec3 p{kGauss[u], kGauss[v], kGauss[w]};
                    // The integral over the cube takes the determinant of `inside`.
                    Eigen::Matrix3d d;
                    for (int k = 0; k < 3; ++k)
                        d.col(k) = (shape.inside(p + 1e-5 * Vec3::Unit(k)) -
                                    shape.inside(p - 1e-5 * Vec3::Unit(k))) /
                                   2e-5;
                    volume += kWeight[u] * kWeight[v] * kWeight[w] * d.determinant() *
                              jacobian(shape, nodes, shape.inside(p));
                }
        CHECK(measured_second(shape, nodes).volume == doctest::Approx(volume).epsilon(1e-6));
        const auto straight = measured_second(shape, with_middles(shape, 0, random));
        const auto first = measured(shape.corners, shape.cell);
        CHECK(straight.min_scaled_jacobian == first.min_scaled_jacobian);
        CHECK(straight.volume == doctest::Approx(first.volume));
        const auto nearly = measured_second(shape, with_middles(shape, 1e-9, random));
        CHECK(nearly.min_scaled_jacobian == doctest::Approx(first.min_scaled_jacobian));
        CHECK(nearly.volume == doctest::Approx(first.volume));
        CHECK(nearly.uncertified == 0);
    }
}

TEST_CASE("mixed cells are proved: counts, least of each kind, volume, and a skin that encloses it")
{
    for (const unsigned seed : {1u, 2u, 3u}) {
        const mesh::TetMesh mixed = test::mixed_cells(4, seed);
        const quality::CellsProof proof = quality::prove_cells(mixed.nodes, mixed.cells);
        CAPTURE((proof.finding ? proof.finding->message.text() : ""));
        REQUIRE_FALSE(proof.finding);
        const quality::Quality& q = proof.quality;
        CHECK(q.hexes == 12);
        CHECK(q.wedges == 8);
        CHECK(q.pyramids == 12);
        CHECK(q.tets == 4 * 12 + 12 * 10);
        CHECK(q.cells() == mixed.cells.size());
        CHECK(q.volume == doctest::Approx(32));
        CHECK(*std::ranges::min_element(q.least_by_kind) == q.min_scaled_jacobian);
        for (std::size_t k = 0; k < 4; ++k) CHECK(q.least_by_kind[k] < 1);
        double volume = 0; // each side as two triangles; the outer ones are flat
        for (const Quad& side : proof.skin)
            for (const std::size_t k : {1, 2})
                volume += mixed.nodes[index(side[0])].dot(
                              mixed.nodes[index(side[k])].cross(mixed.nodes[index(side[k + 1])])) /
                          6;
        CHECK(volume == doctest::Approx(32));
        for (const int threads : {1, 4}) {
            RunContext context;
            context.threads = threads;
            const quality::CellsProof again = quality::prove_cells(mixed.nodes, mixed.cells, context);
            CHECK(again.skin == proof.skin);
            CHECK(again.quality.mean_scaled_jacobian == q.mean_scaled_jacobian);
        }
        const std::string table = quality::to_table(q);
        for (const char* kind : {"hexahedra", "wedges", "pyramids", "tetrahedra"})
            CHECK(table.find(kind) != std::string::npos);
    }
    CHECK(quality::to_table(measured(even_tet(), kTet)).find("hexahedra") == std::string::npos);
}

TEST_CASE("faults of mixed cells are found and called by their names")
{
    mesh::TetMesh mixed = test::mixed_cells(3);
    const auto pyramid = std::ranges::find_if(mixed.cells, mesh::is_pyramid);
    const auto tet = std::ranges::find_if(mixed.cells, mesh::is_tet);
    const auto code = [&] {
        const auto proof = quality::prove_cells(mixed.nodes, mixed.cells);
        CHECK((proof.skin.empty() || !proof.finding));
        return proof.finding ? proof.finding->message.code() : "";
    };
    REQUIRE(code().empty());
    SUBCASE("two tetrahedra against a quad of a hexahedron")
    {
        const Hex p = *pyramid;
        *pyramid = {p[0], p[1], p[2], p[2], p[4], p[4], p[4], p[4]};
        mixed.cells.push_back({p[0], p[2], p[3], p[3], p[4], p[4], p[4], p[4]});
        CHECK(code() == "quality.not_conformal");
    }
    SUBCASE("a folded tetrahedron")
    {
        std::swap((*tet)[0], (*tet)[1]);
        CHECK(code() == "quality.inverted");
    }
    SUBCASE("a tetrahedron twice")
    {
        mixed.cells.push_back(*tet);
        CHECK(code() == "quality.not_conformal");
    }
    SUBCASE("a pyramid with the same node twice")
    {
        (*pyramid)[1] = (*pyramid)[0];
        CHECK(code() == "quality.collapsed_side");
    }
    SUBCASE("a node of no cell")
    {
        mixed.nodes.emplace_back(9, 9, 9);
        CHECK(code() == "quality.unused_node");
    }
    SUBCASE("an unknown node")
    {
        (*tet)[1] = 100000;
        CHECK(code() == "quality.unknown_node");
    }
    SUBCASE("cells that share a place but no nodes")
    {
        const auto old = static_cast<Index>(mixed.nodes.size());
        mixed.nodes.push_back(mixed.nodes[index((*tet)[0])]);
        (*tet)[0] = old;
        CHECK_FALSE(code().empty());
    }
}

TEST_CASE("a proof of cells can be cancelled")
{
    const mesh::TetMesh mixed = test::mixed_cells(3);
    const std::atomic<bool> cancel{true};
    RunContext context;
    context.cancel = &cancel;
    CHECK_THROWS_AS(quality::prove_cells(mixed.nodes, mixed.cells, context), Cancelled);
}
