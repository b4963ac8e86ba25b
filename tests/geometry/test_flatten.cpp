// SPDX-License-Identifier: MIT
#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/flatten.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

constexpr double kPi = std::numbers::pi;

struct Patch {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

/// The image of an n × m grid over the unit square; a cell (i, j) for which `hole` holds is left out.
Patch patch(
    int n, int m, const std::function<Vec3(double, double)>& map,
    const std::function<bool(int, int)>& hole = [](int, int) { return false; })
{
    Patch result;
    result.points = {Vec3(1e3, 0, 0), Vec3(0, 1e3, 0)}; // used by no triangle
    for (int j = 0; j <= m; ++j)
        for (int i = 0; i <= n; ++i) result.points.push_back(map(double(i) / n, double(j) / m));
    for (int j = 0; j < m; ++j)
        for (int i = 0; i < n; ++i) {
            if (hole(i, j)) continue;
            const Index a = 2 + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            result.triangles.push_back({a, b, c});
            result.triangles.push_back({a, c, d});
        }
    return result;
}

/// The point in space at a place of the flat facets; `points` as given to flatten().
Vec3 lifted(const Flattened& flat, const std::vector<Vec3>& points, const PlanarLocator::FacetPosition& place)
{
    const Triangle& triangle = flat.triangles[index(place.triangle)];
    const auto corner = [&](std::size_t i) { return points[index(flat.used[index(triangle[i])])]; };
    return corner(0) + place.barycentric[1] * (corner(1) - corner(0)) +
           place.barycentric[2] * (corner(2) - corner(0));
}

Patch moved(Patch patch, unsigned seed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> any;
    const Eigen::Quaterniond turn(any(random), any(random), any(random), any(random));
    const Eigen::Affine3d motion = Eigen::Translation3d(any(random), any(random), 5) * turn.normalized();
    for (Vec3& point : patch.points) point = motion * point;
    return patch;
}

/// A ball's cap down to `angle` from the pole, from a square grid drawn onto it.
Patch cap(double angle, int n)
{
    return patch(n, n, [&](double s, double t) {
        const Vec2 p(2 * s - 1, 2 * t - 1);
        const double r = p.norm() > 0 ? p.cwiseAbs().maxCoeff() : 0.0;
        const double round = p.norm() > 0 ? std::atan2(p.y(), p.x()) : 0.0, down = r * angle;
        return Vec3(std::sin(down) * std::cos(round), std::sin(down) * std::sin(round), std::cos(down));
    });
}

double flat_area(const Flattened& flat, std::size_t t)
{
    const auto at = [&](std::size_t k) { return flat.position[std::size_t(flat.triangles[t][k])]; };
    const Vec2 a = at(1) - at(0), b = at(2) - at(0);
    return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

double space_area(const Patch& patch, std::size_t t)
{
    const auto at = [&](std::size_t k) { return patch.points[std::size_t(patch.triangles[t][k])]; };
    return 0.5 * Vec3(at(1) - at(0)).cross(at(2) - at(0)).norm();
}

/// What holds for whatever is one to one.
void check_flat(const Patch& patch, const Flattened& flat)
{
    CHECK_FALSE(flat.folded);
    CHECK(flat.flips == 0);
    CHECK_FALSE(flat.overlaps);
    CHECK(flat.max_stretch >= 1);
    REQUIRE(flat.triangles.size() == patch.triangles.size());
    REQUIRE(flat.position.size() == flat.used.size());
    CHECK(std::is_sorted(flat.used.begin(), flat.used.end()));
    double in_plane = 0, in_space = 0, least = 1e300;
    for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(flat.used[std::size_t(flat.triangles[t][k])] == patch.triangles[t][k]);
        in_plane += flat_area(flat, t);
        in_space += space_area(patch, t);
        least = std::min(least, flat_area(flat, t));
    }
    CHECK(least > 0);
    CHECK(in_plane == doctest::Approx(in_space));
    // One to one: no two triangles overlap.
    std::vector<Vec3> points;
    for (const Vec2& p : flat.position) points.emplace_back(p.x(), p.y(), 0);
    const FacetTree tree(points, flat.triangles);
    Index crossings = 0;
    tree.overlaps(tree, [&](Index a, Index b) {
        const auto corners = [&](Index t) {
            const Triangle& c = flat.triangles[std::size_t(t)];
            return std::array<Vec3, 3>{points[std::size_t(c[0])], points[std::size_t(c[1])],
                                       points[std::size_t(c[2])]};
        };
        if (triangles_cross(corners(a), corners(b), 1e-9)) ++crossings;
        return true;
    });
    CHECK(crossings == 0);
}

/// Largest difference of a side's length in the plane and in space.
double largest_error(const Patch& patch, const Flattened& flat)
{
    double worst = 0;
    for (std::size_t t = 0; t < flat.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = std::size_t(flat.triangles[t][k]),
                              b = std::size_t(flat.triangles[t][(k + 1) % 3]);
            const double in_plane = (flat.position[a] - flat.position[b]).norm();
            const double in_space =
                (patch.points[std::size_t(flat.used[a])] - patch.points[std::size_t(flat.used[b])]).norm();
            worst = std::max(worst, std::abs(in_plane - in_space));
        }
    return worst;
}

bool two_holes(int i, int j) { return (i == 2 && j >= 2 && j < 5) || (i >= 5 && i < 7 && j == 6); }

} // namespace

TEST_CASE("planar facets with holes are laid down as they are")
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto shear = [&](double s, double t) {
            return Vec3(3 * s + 0.3 * t * t, t - 0.2 * std::sin(3 * s), 0);
        };
        const Patch flat_patch = moved(patch(9, 9, shear, two_holes), seed);
        const Flattened flat = flatten(flat_patch.points, flat_patch.triangles);
        CHECK(flat.map == FlatMap::plane);
        CHECK(largest_error(flat_patch, flat) < 1e-13);
        CHECK(flat.max_stretch == doctest::Approx(1));
        check_flat(flat_patch, flat);
    }
}

TEST_CASE("prisms and cones unroll without stretch, holes or not")
{
    const std::vector<std::function<Vec3(double, double)>> shapes{
        [](double s, double t) { return Vec3(std::cos(-3 * s), 2 * t, -std::sin(-3 * s)); },
        [](double s, double t) { return Vec3(s, 0.3 * std::sin(9 * s), -2 * t); },
        [](double s, double t) { return Vec3((1 + t) * std::cos(4 * s), (1 + t) * std::sin(4 * s), 2 * t); },
        [](double s, double t) { return Vec3(s, 2 * t, s < 0.5 ? 0.0 : 2 * (s - 0.5)); },
    };
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        CAPTURE(i);
        for (const bool holes : {false, true}) {
            const Patch rolled = moved(
                patch(12, 9, shapes[i], [&](int x, int y) { return holes && two_holes(x, y); }), unsigned(i));
            const Flattened flat = flatten(rolled.points, rolled.triangles);
            CHECK(flat.map == FlatMap::rigid);
            CHECK(largest_error(rolled, flat) < 1e-7);
            check_flat(rolled, flat);
        }
    }
}

TEST_CASE("caps of a ball lie flat, the stretch growing with their depth")
{
    double before = 1;
    for (const double angle : {0.2, 0.6, 1.0, 1.5, 2.0, 2.6}) {
        CAPTURE(angle);
        const Patch ball = cap(angle, 16);
        const Flattened flat = flatten(ball.points, ball.triangles);
        CAPTURE(flat.max_stretch);
        check_flat(ball, flat);
        CHECK(flat.max_stretch > before);
        if (angle < 0.3) CHECK(flat.max_stretch < 1.02);
        if (angle < 1.1) CHECK(flat.max_stretch < 1.4);
        before = flat.max_stretch;
    }
}

TEST_CASE("bumpy sheets with holes lie flat one to one")
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-1, 1);
    for (unsigned seed = 0; seed < 25; ++seed) {
        CAPTURE(seed);
        const double bumps = 0.01 * seed / 2;
        const Patch bumpy = moved(patch(
                                      10, 10,
                                      [&](double s, double t) {
                                          return Vec3(s + 0.02 * any(random), t + 0.02 * any(random),
                                                      0.3 * std::sin(4 * s) * t + bumps * any(random));
                                      },
                                      two_holes),
                                  seed);
        check_flat(bumpy, flatten(bumpy.points, bumpy.triangles));
    }
}

TEST_CASE("a tube is laid down as a ring, a ramp of two turns without covering itself")
{
    Patch tube;
    const int around = 16, up = 5;
    for (int j = 0; j <= up; ++j)
        for (int i = 0; i < around; ++i)
            tube.points.emplace_back(std::cos(2 * kPi * i / around), std::sin(2 * kPi * i / around), 0.2 * j);
    for (Index j = 0; j < up; ++j)
        for (Index i = 0; i < around; ++i) {
            const Index a = j * around + i, b = j * around + (i + 1) % around;
            tube.triangles.push_back({a, b, b + around});
            tube.triangles.push_back({a, b + around, a + around});
        }
    check_flat(tube, flatten(tube.points, tube.triangles));

    const Patch ramp = patch(4, 60, [](double s, double t) {
        const double angle = 4 * kPi * t;
        return Vec3((2 + s) * std::cos(angle), (2 + s) * std::sin(angle), 2 * t);
    });
    const Flattened flat = flatten(ramp.points, ramp.triangles);
    CHECK(flat.map != FlatMap::rigid);
    check_flat(ramp, flat);
}

TEST_CASE("tubes of any shape, height and division are rings, whichever of their rims is the longer")
{
    struct Shape {
        const char* name;
        double height, taper, waves, lean;
    };
    const std::vector<Shape> shapes{{"cylinder", 1, 0, 0, 0},    {"low", 0.1, 0, 0, 0},
                                    {"high", 5, 0, 0, 0},        {"narrowing", 2, -0.6, 0, 0},
                                    {"widening", 2, 0.8, 0, 0},  {"wavy", 1, 0, 0.2, 0},
                                    {"leaning", 2, -0.2, 0.1, 1}};
    std::mt19937 random(3);
    for (const Shape& shape : shapes) {
        for (const auto& [around, up] : {std::pair(7, 2), std::pair(24, 9), std::pair(90, 30)}) {
            CAPTURE(shape.name);
            CAPTURE(around);
            Patch tube;
            for (int j = 0; j <= up; ++j) {
                for (int i = 0; i < around; ++i) {
                    const double t = double(j) / up, a = 2 * kPi * (i + 0.3 * std::sin(5.0 * i + j)) / around;
                    const double r = (1 + shape.taper * t) * (1 + shape.waves * std::sin(3 * a + t));
                    tube.points.emplace_back(r * std::cos(a) + shape.lean * t * t, r * std::sin(a),
                                             shape.height * t);
                }
            }
            for (Index j = 0; j < up; ++j) {
                for (Index i = 0; i < around; ++i) {
                    const Index a = j * around + i, b = j * around + (i + 1) % around;
                    if ((i + j) % 2 == 0) {
                        tube.triangles.push_back({a, b, b + around});
                        tube.triangles.push_back({a, b + around, a + around});
                    } else {
                        tube.triangles.push_back({a, b, a + around});
                        tube.triangles.push_back({b, b + around, a + around});
                    }
                }
            }
            std::shuffle(tube.triangles.begin(), tube.triangles.end(), random);
            const Flattened flat = flatten(tube.points, tube.triangles);
            check_flat(tube, flat);
            if (around > 7) CHECK(flat.map == FlatMap::ring);
        }
    }
}

TEST_CASE("a sheet folded over in its own plane is unfolded")
{
    const Patch folded = patch(10, 6,
                               [](double s, double t) { return Vec3(s < 0.7 ? s : 1.4 - s, 0.8 * t, 0); });
    const Flattened flat = flatten(folded.points, folded.triangles);
    CHECK(flat.map != FlatMap::plane);
    CHECK(largest_error(folded, flat) < 1e-7);
    check_flat(folded, flat);
}

TEST_CASE("facets of no area do no harm")
{
    for (const bool curved : {false, true}) {
        Patch bad = patch(8, 8, [&](double s, double t) { return Vec3(s, t, curved ? s * t : 0.0); });
        // A point in the middle of a side splits one triangle, with a facet of no area for the other.
        const Triangle split = bad.triangles[40];
        const auto middle = Index(bad.points.size());
        bad.points.push_back(0.5 * (bad.points[std::size_t(split[0])] + bad.points[std::size_t(split[2])]));
        bad.triangles[40] = {split[0], split[1], middle};
        bad.triangles.push_back({middle, split[1], split[2]});
        bad.triangles.push_back({split[0], middle, split[2]});
        const Flattened flat = flatten(bad.points, bad.triangles);
        CHECK_FALSE(flat.folded);
        CHECK(flat.max_stretch < 1.5);
        for (const Vec2& p : flat.position) CHECK(p.allFinite());
    }
}

TEST_CASE("the flat facets do not depend on where the facets were, up to rounding")
{
    const Patch ball = cap(1.2, 10);
    const Flattened flat = flatten(ball.points, ball.triangles);
    for (unsigned seed = 1; seed < 5; ++seed) {
        const Patch other = moved(ball, seed);
        const Flattened again = flatten(other.points, other.triangles);
        CHECK(again.used == flat.used);
        for (const Triangle& t : flat.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t a = std::size_t(t[k]), b = std::size_t(t[(k + 1) % 3]);
                const double here = (flat.position[a] - flat.position[b]).norm();
                CHECK((again.position[a] - again.position[b]).norm() == doctest::Approx(here).epsilon(1e-5));
            }
    }
    const Flattened same = flatten(ball.points, ball.triangles);
    CHECK(same.position == flat.position);
}

TEST_CASE("a place of the flat facets is found and lifted back to where it came from")
{
    std::mt19937 random(8);
    std::uniform_real_distribution<double> any(0, 1);
    for (const double angle : {0.5, 1.8}) {
        const Patch ball = moved(cap(angle, 14), 3);
        const Flattened flat = flatten(ball.points, ball.triangles);
        const PlanarLocator locator(flat);
        for (std::size_t t = 0; t < flat.triangles.size(); ++t) {
            Vec3 weights(any(random) + 0.05, any(random) + 0.05, any(random) + 0.05);
            weights /= weights.sum();
            Vec2 place = Vec2::Zero();
            Vec3 expected = Vec3::Zero();
            for (std::size_t k = 0; k < 3; ++k) {
                place += weights[int(k)] * flat.position[std::size_t(flat.triangles[t][k])];
                expected += weights[int(k)] * ball.points[std::size_t(ball.triangles[t][k])];
            }
            const auto found = locator.locate(place);
            CHECK(found.triangle == Index(t));
            CHECK(found.distance < 1e-14);
            CHECK((lifted(flat, ball.points, found) - expected).norm() < 1e-11);
        }
        for (std::size_t i = 0; i < flat.used.size(); ++i) {
            const auto found = locator.locate(flat.position[i]);
            CHECK((lifted(flat, ball.points, found) - ball.points[std::size_t(flat.used[i])]).norm() < 1e-13);
        }
        const auto outside = locator.locate(Vec2(100, 100));
        CHECK(outside.triangle >= 0);
        CHECK(outside.distance > 90);
        CHECK(outside.barycentric.minCoeff() == 0);
    }
    CHECK(PlanarLocator().locate(Vec2(0, 0)).triangle == -1);
}

TEST_CASE("facets that cannot lie flat are refused")
{
    CHECK_THROWS_AS(flatten({}, {}), InvalidInput);
    const std::vector<Vec3> corners{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
    const std::vector<Triangle> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    CHECK_THROWS_AS(flatten(corners, tetrahedron), InvalidInput); // closed
    CHECK_NOTHROW(flatten(corners, std::span(tetrahedron).subspan(1)));
    const std::vector<Triangle> turned{{0, 1, 2}, {0, 1, 3}};
    CHECK_THROWS_AS(flatten(corners, turned), InvalidInput); // not oriented alike

    Patch two = cap(1, 4);
    const auto shift = Index(two.points.size());
    const std::size_t count = two.triangles.size();
    for (Index i = 0; i < shift; ++i) two.points.push_back(two.points[std::size_t(i)] + Vec3(5, 0, 0));
    for (std::size_t t = 0; t < count; ++t) {
        const Triangle c = two.triangles[t];
        two.triangles.push_back({c[0] + shift, c[1] + shift, c[2] + shift});
    }
    CHECK_THROWS_AS(flatten(two.points, two.triangles), InvalidInput); // two parts

    Patch torus;
    const Index n = 8;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double a = 2 * kPi * i / n, b = 2 * kPi * j / n, r = 3 + std::cos(b);
            torus.points.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
        }
    for (Index j = 0; j < n; ++j)
        for (Index i = 0; i < n; ++i) {
            const Index a = j * n + i, b = j * n + (i + 1) % n, c = (j + 1) % n * n + (i + 1) % n,
                        d = (j + 1) % n * n + i;
            torus.triangles.push_back({a, b, c});
            torus.triangles.push_back({a, c, d});
        }
    torus.triangles.pop_back();
    CHECK_THROWS_AS(flatten(torus.points, torus.triangles), InvalidInput); // a handle
}
