// SPDX-License-Identifier: MIT
#include "support/cancelling.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/core/error.h>
#include <lacuna/healing/shared/stitch.h>
#include <lacuna/healing/shared/weld.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/topology/model.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;

namespace {

const Vec3& at(const std::vector<Vec3>& points, Index i) { return points[static_cast<std::size_t>(i)]; }

Index add_point(healing::FacetSoup& soup, const Vec3& p)
{
    soup.points.push_back(p);
    return static_cast<Index>(soup.points.size()) - 1;
}

/// An n × n grid of quads or of pairs of triangles on the patch o + u s + v t; points are its own.
void add_patch(healing::FacetSoup& soup, int n, const Vec3& o, const Vec3& u, const Vec3& v, bool quads)
{
    const auto first = static_cast<Index>(soup.points.size());
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) soup.points.push_back(o + u * i / n + v * j / n);
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const Index a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            if (quads) {
                soup.quads.push_back({a, b, c, d});
            } else {
                soup.triangles.push_back({a, b, c});
                soup.triangles.push_back({a, c, d});
            }
        }
    }
}

/// A unit cube; its six patches do not share points.
healing::FacetSoup box(int n, bool quads)
{
    healing::FacetSoup soup;
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), o(0, 0, 0);
    add_patch(soup, n, o, y, x, quads);
    add_patch(soup, n, z, x, y, quads);
    add_patch(soup, n, o, x, z, quads);
    add_patch(soup, n, y, z, x, quads);
    add_patch(soup, n, o, z, y, quads);
    add_patch(soup, n, x, y, z, quads);
    return soup;
}

/// A closed cylinder: `sides` around, `rows` up, fans for lids.
healing::FacetSoup cylinder(int sides, int rows)
{
    healing::FacetSoup soup;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            add_point(soup, {std::cos(angle), std::sin(angle), 3.0 * j / rows});
        }
    }
    const Index bottom = add_point(soup, {0, 0, 0}), top = add_point(soup, {0, 0, 3});
    for (Index i = 0; i < sides; ++i) {
        const Index next = (i + 1) % sides;
        for (Index j = 0; j < rows; ++j) {
            const Index low = j * sides, high = low + sides;
            soup.triangles.push_back({low + i, low + next, high + next});
            soup.triangles.push_back({low + i, high + next, high + i});
        }
        soup.triangles.push_back({bottom, next, i});
        soup.triangles.push_back({top, rows * sides + i, rows * sides + next});
    }
    return soup;
}

/// Shuffle the facets, turn and flip some, renumber the points and give some of them twice.
healing::FacetSoup scrambled(const healing::FacetSoup& soup, unsigned seed)
{
    std::mt19937 dice(seed);
    healing::FacetSoup result;
    std::vector<Index> order(soup.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
    std::shuffle(order.begin(), order.end(), dice);
    std::vector<Index> number(order.size());
    for (const Index p : order) {
        number[static_cast<std::size_t>(p)] = add_point(result, at(soup.points, p));
        if (dice() % 3 == 0) add_point(result, at(soup.points, p) + 1e-9 * Vec3(1, -1, 1));
    }
    result.triangles = soup.triangles;
    std::shuffle(result.triangles.begin(), result.triangles.end(), dice);
    for (Triangle& t : result.triangles) {
        for (Index& p : t) {
            p = number[static_cast<std::size_t>(p)];
            const bool doubled = static_cast<std::size_t>(p) + 1 < result.points.size() &&
                                 (at(result.points, p + 1) - at(result.points, p)).norm() < 1e-8;
            if (doubled && dice() % 2) ++p;
        }
        std::rotate(t.begin(), t.begin() + dice() % 3, t.end());
        if (dice() % 3 == 0) std::swap(t[0], t[1]);
    }
    return result;
}

/// A face as the rounded centres of its facets: what does not depend on any order.
std::set<std::set<std::array<long, 3>>> faces_as_sets(const Model& model)
{
    std::set<std::set<std::array<long, 3>>> result;
    for (const Face& face : model.faces) {
        std::set<std::array<long, 3>> centres;
        for (const Triangle& t : face.triangles) {
            const Vec3 c = (model.at(t[0]) + model.at(t[1]) + model.at(t[2])) / 3 * 1e5;
            centres.insert({std::lround(c.x()), std::lround(c.y()), std::lround(c.z())});
        }
        result.insert(centres);
    }
    return result;
}

/// What holds for every model that comes out.
void check_model(const Model& model)
{
    std::set<Index> used;
    std::set<std::pair<Index, Index>> on_edges;
    for (std::size_t v = 0; v < model.vertices.size(); ++v)
        CHECK(model.vertices[v].tag == static_cast<int>(v) + 1);
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        const Edge& edge = model.edges[e];
        CHECK(edge.tag == static_cast<int>(e) + 1);
        REQUIRE(edge.points.size() >= 2);
        CHECK(model[edge.from].point == edge.points.front());
        CHECK(model[edge.to].point == edge.points.back());
        for (std::size_t i = 0; i + 1 < edge.points.size(); ++i) {
            CHECK(on_edges.insert(std::minmax(edge.points[i], edge.points[i + 1])).second);
        }
    }
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const Face& face = model.faces[f];
        CHECK(face.tag == static_cast<int>(f) + 1);
        REQUIRE(!face.triangles.empty());
        std::set<std::pair<Index, Index>> sides;
        for (const Triangle& t : face.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                used.insert(t[k]);
                CHECK(sides.insert({t[k], t[(k + 1) % 3]}).second); // consistent, a manifold
            }
        }
        std::size_t border = 0;
        for (const auto& [a, b] : sides) {
            if (sides.count({b, a})) continue;
            ++border;
            CHECK(on_edges.count(std::minmax(a, b)) == 1);
        }
        std::size_t in_loops = 0;
        for (const Loop& loop : face.loops) {
            for (std::size_t i = 0; i < loop.uses.size(); ++i) {
                const auto points = use_points(model, loop.uses[i]);
                CHECK(points.back() == use_points(model, loop.uses[(i + 1) % loop.uses.size()]).front());
                for (std::size_t k = 0; k + 1 < points.size(); ++k)
                    CHECK(sides.count({points[k], points[k + 1]}) == 1);
                in_loops += points.size() - 1;
            }
        }
        CHECK(in_loops == border);
    }
    CHECK(used.size() == model.points.size());
}

std::array<std::size_t, 3> counts(const Model& model)
{
    return {model.faces.size(), model.edges.size(), model.vertices.size()};
}

using Counts = std::array<std::size_t, 3>;

healing::FacetSoup read_stl(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    std::vector<char> bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    REQUIRE(bytes.size() > 84);
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, 4);
    REQUIRE(bytes.size() == 84 + 50 * std::size_t{count});
    healing::FacetSoup soup;
    for (std::size_t t = 0; t < count; ++t) {
        std::array<float, 9> xyz;
        std::memcpy(xyz.data(), bytes.data() + 84 + 50 * t + 12, 36);
        Triangle corner;
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = add_point(soup, Vec3(xyz[3 * k], xyz[3 * k + 1], xyz[3 * k + 2]));
        soup.triangles.push_back(corner);
    }
    return soup;
}

} // namespace

TEST_CASE("a box has 6 plane faces, 12 edges, 8 vertices, in triangles and in quads")
{
    for (const int n : {1, 2, 5}) {
        for (const bool quads : {false, true}) {
            CAPTURE(n);
            CAPTURE(quads);
            const Model model = healing::split_facets(box(n, quads));
            CHECK(counts(model) == Counts{6, 12, 8});
            check_model(model);
            CHECK(model.points.size() == static_cast<std::size_t>(6 * n * n + 2));
            for (const Face& face : model.faces) {
                CHECK(face.kind == "plane");
                CHECK(face.triangles.size() == static_cast<std::size_t>(2 * n * n));
                CHECK(face.given_quads.size() == static_cast<std::size_t>(quads ? n * n : 0));
                REQUIRE(face.loops.size() == 1);
                CHECK(face.loops[0].uses.size() == 4);
            }
        }
    }
}

TEST_CASE(
    "a cylinder has 3 faces and 2 closed edges, each with a vertex, at any turn below the feature angle")
{
    for (const int sides : {12, 13, 40}) {
        for (const int rows : {1, 6}) {
            CAPTURE(sides);
            const Model model = healing::split_facets(cylinder(sides, rows));
            CHECK(counts(model) == Counts{3, 2, 2});
            check_model(model);
            for (const Edge& edge : model.edges) CHECK(edge.from == edge.to);
            CHECK(model.faces[0].kind == "discrete");
            CHECK(model.faces[0].loops.size() == 2);
            CHECK(model.faces[1].kind == "plane");
        }
    }
    // A turn of 45° is cut at 40 and at 44.9, and not at 45: the angle itself counts as smooth.
    CHECK(healing::split_facets(cylinder(8, 2)).faces.size() == 10);
    CHECK(healing::split_facets(cylinder(8, 2), {.feature_angle = 44.9}).faces.size() == 10);
    CHECK(healing::split_facets(cylinder(8, 2), {.feature_angle = 45}).faces.size() == 3);
}

TEST_CASE("neither the order nor the direction of facets and points changes the faces found")
{
    for (const healing::FacetSoup& soup : {box(4, false), cylinder(16, 3)}) {
        const Model plain = healing::split_facets(soup);
        for (unsigned seed = 1; seed <= 12; ++seed) {
            CAPTURE(seed);
            const Model model = healing::split_facets(scrambled(soup, seed));
            check_model(model);
            CHECK(faces_as_sets(model) == faces_as_sets(plain));
            CHECK(counts(model) == counts(plain));
            CHECK(model.points.size() == plain.points.size());
        }
    }
}

TEST_CASE("a fillet is one with the faces it rounds, and thin facets do not cut it")
{
    // An L whose corner is rounded in steps; each strip is cut by a facet with almost no height.
    for (const int steps : {3, 9, 60}) {
        CAPTURE(steps);
        healing::FacetSoup soup;
        std::vector<Vec3> section{{-2, 1, 0}};
        for (int i = 0; i <= steps; ++i) {
            const double angle = std::numbers::pi / 2 * i / steps;
            section.emplace_back(std::sin(angle), std::cos(angle), 0);
        }
        section.emplace_back(1, -2, 0);
        for (std::size_t i = 0; i + 1 < section.size(); ++i) {
            const Vec3 up(0, 0, 5), mid(1e-9, 3e-9, 2.5);
            const Index a = add_point(soup, section[i]), b = add_point(soup, section[i + 1]);
            const Index c = add_point(soup, section[i + 1] + up), d = add_point(soup, section[i] + up);
            soup.triangles.push_back({b, c, d});
            if (i == 0) {
                soup.triangles.push_back({a, b, d});
                continue;
            }
            // This strip's left side is in two pieces, the right side of the one before in one.
            const Index m = add_point(soup, section[i] + mid);
            soup.triangles.push_back({a, b, m});
            soup.triangles.push_back({m, b, d});
            soup.triangles.push_back({a, m, d});
        }
        const Model model = healing::split_facets(soup);
        check_model(model);
        CHECK(model.faces.size() == 1);
    }
}

TEST_CASE("labels cut where nothing turns, and give their names")
{
    healing::FacetSoup soup;
    add_patch(soup, 4, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, false);
    add_patch(soup, 4, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, false);
    CHECK(counts(healing::split_facets(soup)) == Counts{1, 4, 4});
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) soup.triangle_label.push_back(t < 32 ? 0 : 1);
    soup.label_name = {"left"};
    const Model model = healing::split_facets(soup);
    check_model(model);
    CHECK(model.faces.size() == 2);
    CHECK(model.faces[0].name == "left");
    CHECK(model.faces[1].name.empty());
    CHECK(counts(model) == Counts{2, 7, 6});
}

TEST_CASE("an edge of three facets separates faces, and parts that lie on each other stay two")
{
    healing::FacetSoup tee;
    add_patch(tee, 3, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, false);
    add_patch(tee, 3, {1, 0, 0}, {1, 0, 0}, {0, 1, 0}, false);
    add_patch(tee, 3, {1, 0, 0}, {0, 1, 0}, {0.0, 0, 1}, false);
    const Model model = healing::split_facets(tee);
    check_model(model);
    CHECK(model.faces.size() == 3);

    healing::FacetSoup twice;
    add_patch(twice, 3, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, false);
    add_patch(twice, 3, {0, 0, 0}, {0, 1, 0}, {1, 0, 0}, false);
    twice.triangle_label.assign(36, 0);
    std::fill(twice.triangle_label.begin() + 18, twice.triangle_label.end(), 1);
    const Model both = healing::split_facets(twice);
    check_model(both);
    CHECK(counts(both) == Counts{2, 4, 4});
}

TEST_CASE("a closed smooth surface is one face without edges")
{
    healing::FacetSoup soup = box(12, false);
    for (Vec3& p : soup.points) p = (p - Vec3(0.5, 0.5, 0.5)).normalized();
    const Model model = healing::split_facets(soup, {.tolerance = 1e-4});
    check_model(model);
    CHECK(counts(model) == Counts{1, 0, 0});
}

TEST_CASE("a Möbius band, no facets, bad numbers and bad options are refused")
{
    healing::FacetSoup band;
    const int n = 40;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        const Vec3 out(std::cos(angle), std::sin(angle), 0);
        const Vec3 across = std::cos(angle / 2) * Vec3(0, 0, 1) + std::sin(angle / 2) * out;
        add_point(band, 2 * out - 0.3 * across);
        add_point(band, 2 * out + 0.3 * across);
    }
    for (Index i = 0; i < n; ++i) {
        const Index a = 2 * i, b = a + 1;
        const bool last = i + 1 == n;
        const Index c = last ? 1 : a + 2, d = last ? 0 : a + 3;
        band.triangles.push_back({a, c, d});
        band.triangles.push_back({a, d, b});
    }
    CHECK_THROWS_WITH_AS(healing::split_facets(band), doctest::Contains("one-sided"), InvalidInput);

    CHECK_THROWS_AS(healing::split_facets({}), InvalidInput);
    healing::FacetSoup soup = box(1, false);
    CHECK_THROWS_AS(healing::split_facets(soup, {.feature_angle = 0}), InvalidInput);
    CHECK_THROWS_AS(healing::split_facets(soup, {.tolerance = 100}), InvalidInput);
    soup.triangle_label = {1, 2};
    CHECK_THROWS_AS(healing::split_facets(soup), InvalidInput);
    soup.triangle_label.clear();
    soup.triangles[0][1] = 999;
    CHECK_THROWS_WITH_AS(healing::split_facets(soup), doctest::Contains("point 1000"), InvalidInput);
}

TEST_CASE("faces are the same at every size whose areas are numbers, and other sizes are refused")
{
    const Counts as_drawn = counts(healing::split_facets(box(2, true)));
    for (const double size : {1e-323, 1e-200, 1e-80, 1e-60, 1e-9, 1e9, 1e60, 1e80, 1e200, 1e308}) {
        CAPTURE(size);
        healing::FacetSoup soup = box(2, true);
        for (Vec3& p : soup.points) p *= size;
        if (size > 1e-70 && size < 1e70)
            CHECK(counts(healing::split_facets(soup)) == as_drawn);
        else
            CHECK(test::refusal([&] { (void)healing::split_facets(soup); }, {"scale"}) == "topology.size");
    }
}

TEST_CASE("weld joins what is within tolerance and nothing else, as comparing all pairs does")
{
    for (unsigned seed = 0; seed < 30; ++seed) {
        std::mt19937 dice(seed);
        std::uniform_real_distribution<double> place(-1, 1);
        std::vector<Vec3> points;
        for (int i = 0; i < 300; ++i) {
            points.emplace_back(place(dice), place(dice), 0.05 * place(dice));
            if (i % 4 == 0) points.push_back(points[dice() % points.size()]);
        }
        for (const double tolerance : {0.0, 1e-3, 0.05, 0.4}) {
            const auto joined = healing::weld(points, tolerance);
            std::vector<Index> wanted(points.size());
            for (std::size_t i = 0; i < points.size(); ++i) {
                wanted[i] = static_cast<Index>(i);
                double best = tolerance;
                for (std::size_t j = i; j-- > 0;) {
                    const double distance = (points[i] - points[j]).norm();
                    if (wanted[j] == static_cast<Index>(j) && distance <= best) {
                        wanted[i] = static_cast<Index>(j);
                        best = distance;
                    }
                }
                const auto same = std::find(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i),
                                            points[i]);
                wanted[i] = wanted[static_cast<std::size_t>(same - points.begin())];
            }
            CHECK(joined == wanted);
        }
    }
}

TEST_CASE("scanned parts: faces, bores and a watertight skin")
{
    const std::filesystem::path data = std::filesystem::path(LACUNA_SOURCE_DIR) / ".." / "shared" / "data" /
                                       "stl";
    if (!std::filesystem::exists(data)) {
        MESSAGE("no shared data beside the sources: skipped");
        return;
    }
    for (const char* name : {"bracket_01.stl", "hollow_brick_2x4.stl"}) {
        CAPTURE(name);
        const healing::FacetSoup soup = read_stl(data / name);
        Model model = healing::split_facets(soup, {.feature_angle = 30});
        check_model(model);
        MESSAGE(std::string(name) << ": " << model.faces.size() << " faces, " << model.edges.size()
                                  << " edges, " << model.vertices.size() << " vertices");
        std::size_t facets = 0;
        std::size_t bores = 0;
        for (const Face& face : model.faces) {
            facets += face.triangles.size();
            const bool bore = face.triangles.size() == 252 && face.loops.size() == 2;
            bores += bore ? 1 : 0;
        }
        CHECK(facets == soup.triangles.size());
        if (name == std::string("bracket_01.stl")) CHECK(bores == 5);
        CHECK_NOTHROW(orient_consistently(model));
    }
}

TEST_CASE("splitting and stitching stop within half a second, and leave the model alone")
{
    const healing::FacetSoup soup = box(150, false); // 270,000 facets
    for (const int wait : {0, 50, 150, 300}) {
        CAPTURE(wait);
        const auto seconds = test::stops_within(std::chrono::milliseconds(wait),
                                                [&](const RunContext& context) {
                                                    for (;;) (void)healing::split_facets(soup, {}, context);
                                                });
        REQUIRE(seconds);
        CHECK(*seconds < 0.5);
    }
    Model model = healing::split_facets(box(4, true));
    const std::size_t points = model.points.size();
    CHECK(
        test::heeds_cancel([&](const RunContext& context) { (void)healing::stitch(model, 1e-6, context); }));
    CHECK(model.points.size() == points);
}

TEST_CASE("facets that hang together nowhere are split and stitched, and stop within half a second")
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(0, 1);
    const auto at = [&] { return Vec3(place(random), place(random), place(random)); };
    healing::FacetSoup soup;
    for (Index f = 0; f < 60000; ++f) {
        const Vec3 middle = at();
        for (int k = 0; k < 3; ++k) soup.points.push_back(middle + 0.01 * at());
        soup.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
    }
    const auto work = [&](const RunContext& context) {
        Model model = healing::split_facets(soup, {}, context);
        (void)healing::stitch(model, model.tolerance, context);
    };
    RunContext alone;
    alone.threads = 1;
    const double before = test::processor_time();
    work(alone);
    const double whole = test::processor_time() - before;
    for (const double share : {0.05, 0.2, 0.35, 0.5, 0.65, 0.8}) {
        CAPTURE(share);
        const auto seconds = test::stops_after(share * whole, test::processor_time, alone, work);
        if (seconds) CHECK(*seconds < std::max(0.1, 0.2 * whole));
    }
}

TEST_CASE("a damaged coordinate that makes every facet too small is named")
{
    for (const int sides : {3, 4, 6}) {
        for (std::size_t damaged = 0; damaged < 5; ++damaged) {
            for (const Eigen::Index axis : {0, 1, 2}) {
                healing::FacetSoup soup = test::prism({.sides = sides}).soup;
                soup.points[damaged][axis] = -3e38;
                CAPTURE(sides);
                CAPTURE(damaged);
                CAPTURE(axis);
                const auto split = [&] { (void)healing::split_facets(soup); };
                CHECK(test::refusal(split, {"-3e+38", "remove the point at"}) == "topology.no_facets");
            }
        }
    }
}

TEST_CASE("parts so far from each other that most facets are too small are refused, with what to give")
{
    for (const double away : {1e2, 1e4, 1e6, 1e8}) {
        CAPTURE(away);
        healing::FacetSoup soup = box(1, false);
        const healing::FacetSoup one = box(1, false);
        const auto first = static_cast<Index>(soup.points.size());
        for (const Vec3& p : one.points) soup.points.push_back(p + Vec3(away, 0, 0));
        for (const Triangle& t : one.triangles)
            soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
        const auto split = [&] { (void)healing::split_facets(soup); };
        if (away < 1e5)
            CHECK(healing::split_facets(soup).faces.size() == 12);
        else
            CHECK(test::refusal(split, {"give a tolerance"}).starts_with("topology."));
        CHECK(healing::split_facets(soup, {.tolerance = 1e-3}).faces.size() == 12);
    }
}

TEST_CASE("facets smaller than the tolerance are left out with a note")
{
    for (const int small : {1, 3}) {
        healing::FacetSoup soup = box(3, false);
        for (int i = 0; i < small; ++i) {
            const Vec3 at(0.1 * i, 0.5, 2);
            soup.triangles.push_back({add_point(soup, at), add_point(soup, at + Vec3(1e-8, 0, 0)),
                                      add_point(soup, at + Vec3(0, 1e-8, 0))});
        }
        const Model model = healing::split_facets(soup);
        CHECK(model.faces.size() == 6);
        REQUIRE(model.notes.size() == 1);
        CHECK(model.notes[0].text().starts_with(std::to_string(small) + " facet"));
        CHECK(model.notes[0].text().ends_with("and left out"));
    }
}
