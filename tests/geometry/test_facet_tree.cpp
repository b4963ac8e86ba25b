// SPDX-License-Identifier: MIT
#include <lacuna/geometry/shared/facet_tree.h>

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>

using namespace lacuna;
using namespace lacuna::geometry;

namespace {

struct Soup {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    [[nodiscard]] std::array<Vec3, 3> corners(std::size_t t) const
    {
        const Triangle& c = triangles[t];
        const auto at = [&](Index i) { return points[static_cast<std::size_t>(i)]; };
        return {at(c[0]), at(c[1]), at(c[2])};
    }
};

/// Triangles here and there, a few of them lines, points, or twice the same.
Soup random_soup(unsigned seed, int count)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-1, 1);
    Soup soup;
    for (int i = 0; i < count; ++i) {
        const Vec3 at(any(random), any(random), any(random));
        const auto first = static_cast<Index>(soup.points.size());
        for (int k = 0; k < 3; ++k)
            soup.points.push_back(at + 0.2 * Vec3(any(random), any(random), any(random)));
        const auto last = soup.points.end() - 1;
        if (i % 11 == 3) *last = 0.5 * (last[-1] + last[-2]);
        if (i % 11 == 5)
            soup.triangles.push_back({first, first, first});
        else
            soup.triangles.push_back({first, first + 1, first + 2});
        if (i % 11 == 7) soup.triangles.push_back(soup.triangles.back());
    }
    return soup;
}

/// A closed ball, facing outward.
Soup ball(int rings, int around)
{
    Soup soup;
    const double pi = std::numbers::pi;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < around; ++i) {
            const double a = 2 * pi * i / around, b = pi * j / rings;
            // The poles are one point each, exactly.
            const double r = j == 0 || j == rings ? 0.0 : std::sin(b);
            soup.points.emplace_back(r * std::cos(a), r * std::sin(a), std::cos(b));
        }
    const auto at = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < around; ++i) {
            if (j + 1 < rings) soup.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            if (j > 0) soup.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return soup;
}

} // namespace

TEST_CASE("the closest place agrees with a search over all triangles")
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-2, 2);
    for (unsigned seed = 0; seed < 8; ++seed) {
        const Soup soup = random_soup(seed, 5 + 60 * static_cast<int>(seed));
        const FacetTree tree(soup.points, soup.triangles);
        CHECK(tree.size() == soup.triangles.size());
        for (int trial = 0; trial < 300; ++trial) {
            const Vec3 p(any(random), any(random), any(random));
            FacetTree::Hit best;
            for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
                FacetTree::Hit hit = closest_on_triangle(p, soup.corners(t));
                hit.triangle = static_cast<Index>(t);
                if (hit.distance2 < best.distance2) best = hit;
            }
            const FacetTree::Hit hit = tree.closest(p);
            CHECK(hit.triangle == best.triangle);
            CHECK(hit.distance2 == best.distance2);
            CHECK(tree.closest(p, best.distance2).triangle == best.triangle);
            CHECK(tree.closest(p, 0.99 * best.distance2).triangle == -1);
        }
    }
}

TEST_CASE("the closest place of a triangle is on it and no sampled point of it is nearer")
{
    std::mt19937 random(12);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 500; ++trial) {
        std::array<Vec3, 3> c;
        for (Vec3& corner : c) corner = Vec3(any(random), any(random), any(random));
        if (trial % 5 == 1) c[2] = c[0] + 1e-9 * Vec3(any(random), any(random), any(random));
        if (trial % 5 == 2) c[2] = 0.3 * c[0] + 0.7 * c[1];
        if (trial % 5 == 3) c[1] = c[2] = c[0];
        const Vec3 p = 2 * Vec3(any(random), any(random), any(random));
        const FacetTree::Hit hit = closest_on_triangle(p, c);
        CHECK(hit.barycentric.minCoeff() >= 0);
        CHECK(hit.barycentric.sum() == doctest::Approx(1));
        const Vec3 rebuilt = hit.barycentric[0] * c[0] + hit.barycentric[1] * c[1] +
                             hit.barycentric[2] * c[2];
        CHECK((rebuilt - hit.point).norm() < 1e-14);
        CHECK(hit.distance2 == doctest::Approx((p - hit.point).squaredNorm()));
        for (int i = 0; i <= 20; ++i)
            for (int j = 0; i + j <= 20; ++j) {
                const Vec3 sample = (i * c[0] + j * c[1] + (20 - i - j) * c[2]) / 20;
                CHECK((p - sample).norm() >= (p - hit.point).norm() - 1e-12);
            }
    }
}

TEST_CASE("of triangles equally close the lowest is given")
{
    const Soup soup = ball(8, 12);
    const FacetTree tree(soup.points, soup.triangles);
    for (std::size_t i = 12; i + 12 < soup.points.size(); ++i) {
        Index lowest = -1;
        for (std::size_t t = soup.triangles.size(); t-- > 0;)
            for (const Index corner : soup.triangles[t])
                if (static_cast<std::size_t>(corner) == i) lowest = static_cast<Index>(t);
        const FacetTree::Hit hit = tree.closest(soup.points[i]);
        CHECK(hit.distance2 == 0);
        CHECK(hit.triangle == lowest);
    }
}

TEST_CASE("no triangles, no hits")
{
    const FacetTree empty;
    CHECK(empty.closest(Vec3(1, 2, 3)).triangle == -1);
    CHECK(empty.first_along(Vec3(0, 0, 0), Vec3(1, 0, 0)).triangle == -1);
    CHECK(empty.winding_number(Vec3(0, 0, 0)) == 0);
    CHECK(empty.overlaps(empty, [](Index, Index) { return false; }));
}

TEST_CASE("overlapping pairs agree with a comparison of all boxes")
{
    const Soup a = random_soup(21, 150), b = random_soup(22, 90);
    const FacetTree ta(a.points, a.triangles), tb(b.points, b.triangles);
    const auto box = [](const std::array<Vec3, 3>& c) {
        Eigen::AlignedBox3d result(c[0]);
        result.extend(c[1]);
        result.extend(c[2]);
        return result;
    };
    for (const double margin : {0.0, 0.05}) {
        std::set<std::pair<Index, Index>> expected, expected_self, found, found_self;
        const auto close = [&](const std::array<Vec3, 3>& x, const std::array<Vec3, 3>& y) {
            Eigen::AlignedBox3d grown = box(x);
            grown.min().array() -= margin;
            grown.max().array() += margin;
            return grown.intersects(box(y));
        };
        for (std::size_t i = 0; i < a.triangles.size(); ++i) {
            for (std::size_t j = 0; j < b.triangles.size(); ++j)
                if (close(a.corners(i), b.corners(j))) expected.insert({Index(i), Index(j)});
            for (std::size_t j = i + 1; j < a.triangles.size(); ++j)
                if (close(a.corners(i), a.corners(j))) expected_self.insert({Index(i), Index(j)});
        }
        int visits = 0;
        const auto into = [&](auto& set) {
            return [&](Index i, Index j) {
                ++visits;
                set.insert({i, j});
                return true;
            };
        };
        CHECK(ta.overlaps(tb, into(found), margin));
        CHECK(ta.overlaps(ta, into(found_self), margin));
        CHECK(found == expected);
        CHECK(found_self == expected_self);
        CHECK(static_cast<std::size_t>(visits) == found.size() + found_self.size());
    }
    int left = 5;
    CHECK_FALSE(ta.overlaps(tb, [&](Index, Index) { return --left > 0; }));
    CHECK(left == 0);
}

TEST_CASE("rays meet what a search over all triangles meets, the first one first")
{
    std::mt19937 random(31);
    std::normal_distribution<double> any;
    const Soup soup = random_soup(32, 300);
    const FacetTree tree(soup.points, soup.triangles);
    for (int trial = 0; trial < 200; ++trial) {
        const Vec3 origin(any(random), any(random), any(random));
        Vec3 direction(any(random), any(random), any(random));
        if (trial % 4 == 0) direction = Vec3::Unit(trial % 3) * (trial % 8 == 0 ? -1 : 1);
        std::set<Index> expected, found;
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            Soup one = soup;
            one.triangles = {soup.triangles[t]};
            if (FacetTree(one.points, one.triangles).first_along(origin, direction).triangle == 0)
                expected.insert(Index(t));
        }
        FacetTree::RayHit nearest;
        tree.all_along(origin, direction, [&](const FacetTree::RayHit& hit) {
            found.insert(hit.triangle);
            if (hit.t < nearest.t || (hit.t == nearest.t && hit.triangle < nearest.triangle)) nearest = hit;
            const auto c = soup.corners(static_cast<std::size_t>(hit.triangle));
            const Vec3& w = hit.barycentric;
            const Vec3 place = w[0] * c[0] + w[1] * c[1] + w[2] * c[2];
            CHECK((place - (origin + hit.t * direction)).norm() < 1e-9);
            return true;
        });
        CHECK(found == expected);
        CHECK(tree.first_along(origin, direction).triangle == nearest.triangle);
    }
}

TEST_CASE("a ball is wound round once inside, not at all outside, and rays agree")
{
    std::mt19937 random(41);
    std::uniform_real_distribution<double> any(-1.5, 1.5);
    const Soup soup = ball(12, 16);
    const FacetTree tree(soup.points, soup.triangles);
    for (int trial = 0; trial < 200; ++trial) {
        const Vec3 p(any(random), any(random), any(random));
        if (p.norm() > 0.93 && p.norm() < 1.01) continue;
        const bool inside = p.norm() < 1;
        CHECK(tree.winding_number(p) == doctest::Approx(inside ? 1 : 0).epsilon(1e-9));
        int crossings = 0;
        tree.all_along(p, Vec3(0.3, 0.5, 0.7), [&](const FacetTree::RayHit&) {
            ++crossings;
            return true;
        });
        CHECK(crossings % 2 == (inside ? 1 : 0));
    }
}

TEST_CASE("triangles that pierce each other cross, those that touch do not")
{
    using T = std::array<Vec3, 3>;
    const T flat{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
    const double tolerance = 1e-6;
    struct Case {
        const char* what;
        T other;
        bool cross;
    };
    const std::vector<Case> cases{
        {"pierced in the middle", {Vec3(1, 1, -1), Vec3(1, 1, 1), Vec3(1.5, 2, 1)}, true},
        {"across a side", {Vec3(1, -1, -1), Vec3(1, -1, 1), Vec3(1, 1, 0.1)}, true},
        {"from a shared corner through the inside", {Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(1, 1, -1)}, true},
        {"folded onto it, one side shared", {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(1, 1, 0)}, true},
        {"in its plane, overlapping", {Vec3(1, 1, 0), Vec3(5, 5, 0), Vec3(1, 5, 0)}, true},
        {"the same", flat, true},
        {"a side shared", {Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(1, 1, 1)}, false},
        {"a side shared, flat beyond it", {Vec3(4, 0, 0), Vec3(0, 0, 0), Vec3(1, -1, 0)}, false},
        {"a corner shared", {Vec3(0, 0, 0), Vec3(-1, -1, 1), Vec3(-1, -1, -1)}, false},
        {"a corner shared, in the plane", {Vec3(0, 0, 0), Vec3(-1, 0, 0), Vec3(0, -1, 0)}, false},
        {"resting on a corner", {Vec3(1, 1, 0), Vec3(2, 1, 1), Vec3(1, 2, 1)}, false},
        {"resting on a side", {Vec3(1, 1, 0), Vec3(2, 1, 0), Vec3(1, 2, 1)}, false},
        {"a corner on its side", {Vec3(2, 0, 0), Vec3(2, -1, 1), Vec3(2, -1, -1)}, false},
        {"beside it", {Vec3(5, 5, -1), Vec3(5, 5, 1), Vec3(6, 6, 0)}, false},
        {"above it", {Vec3(1, 1, 0.1), Vec3(2, 1, 0.1), Vec3(1, 2, 0.3)}, false},
        {"through it by less than the tolerance", {Vec3(1, 1, -1e-7), Vec3(2, 1, 1), Vec3(1, 2, 1)}, false},
    };
    std::mt19937 random(51);
    std::normal_distribution<double> any;
    for (const Case& c : cases) {
        CAPTURE(c.what);
        for (int trial = 0; trial < 30; ++trial) {
            const Eigen::Quaterniond q(any(random), any(random), any(random), any(random));
            const Eigen::Affine3d motion = Eigen::Translation3d(any(random), 9, 7) * q.normalized();
            T a, b;
            for (std::size_t k = 0; k < 3; ++k) {
                a[k] = motion * flat[(k + static_cast<std::size_t>(trial)) % 3];
                b[k] = motion * c.other[trial % 2 ? k : 2 - k];
            }
            CHECK(triangles_cross(a, b, tolerance) == c.cross);
            CHECK(triangles_cross(b, a, tolerance) == c.cross);
        }
    }
}

TEST_CASE("no two facets of a ball cross, even with no tolerance")
{
    Soup soup = ball(12, 17);
    const Eigen::AngleAxisd turn(0.3, Vec3(1, 2, 3).normalized());
    for (Vec3& point : soup.points) point = turn * point + Vec3(10, 20, 30);
    const FacetTree tree(soup.points, soup.triangles);
    int pairs = 0;
    tree.overlaps(tree, [&](Index a, Index b) {
        ++pairs;
        CHECK_FALSE(triangles_cross(soup.corners(std::size_t(a)), soup.corners(std::size_t(b)), 0));
        return true;
    });
    CHECK(pairs > 500);
}
