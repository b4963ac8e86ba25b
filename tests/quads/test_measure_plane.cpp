// SPDX-License-Identifier: MIT
#include "plane_grids.h"

#include <lacuna/quads/shared/measure_plane.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
using test::PlaneGrid;

TEST_CASE("a grid of squares is perfect, whatever its size, place and direction")
{
    for (const int m : {1, 2, 5, 8}) {
        for (const int n : {1, 3, 6}) {
            for (const double angle : {0.0, 0.3, 2.0}) {
                CAPTURE(m);
                CAPTURE(n);
                PlaneGrid grid = test::plane_grid(m, n);
                const auto move = [&](const Vec2& p) {
                    return Vec2(Eigen::Rotation2Dd(angle) * (7.0 * p) + Vec2(-3, 11));
                };
                test::map(grid, move);
                grid.region.size = [](const Vec2&) { return 7.0; };
                CHECK(quads::find_fault(grid.mesh, grid.region) == "");
                const quads::PlaneQuality q = quads::measure_plane(grid.mesh, grid.region);
                CHECK(q.quads == static_cast<std::size_t>(m * n));
                CHECK(q.min_scaled_jacobian == doctest::Approx(1));
                CHECK(q.mean_scaled_jacobian == doctest::Approx(1));
                CHECK(q.interior == static_cast<std::size_t>((m - 1) * (n - 1)));
                CHECK(q.irregular == 0);
                CHECK(q.boundary_irregular == 0);
                CHECK(q.rows == static_cast<std::size_t>(2 * (m + n)));
                CHECK(q.row_share() == 1);
                CHECK(q.edges == static_cast<std::size_t>(m * (n + 1) + n * (m + 1)));
                CHECK(q.size_share() == 1);
                CHECK(q.mean_edge_ratio == doctest::Approx(1));
            }
        }
    }
}

TEST_CASE(
    "the scaled Jacobian of a rhombus is the sine of its corner, and a row is good up to twenty degrees")
{
    for (const int degrees : {90, 80, 72, 68, 60, 45, 30}) {
        CAPTURE(degrees);
        const double angle = degrees * std::numbers::pi / 180;
        PlaneGrid grid = test::plane_grid(4, 3);
        test::map(grid, [&](const Vec2& p) {
            return Vec2(p.x() + p.y() * std::cos(angle), p.y() * std::sin(angle));
        });
        const quads::PlaneQuality q = quads::measure_plane(grid.mesh, grid.region);
        CHECK(q.min_scaled_jacobian == doctest::Approx(std::sin(angle)));
        CHECK(q.mean_scaled_jacobian == doctest::Approx(std::sin(angle)));
        CHECK((q.row_share() == 1) == (degrees >= 70));
    }
}

TEST_CASE("what rows a corner's angle allows holds for all meshes of the sector")
{
    for (const double degrees : {30, 65, 75, 90, 105, 115, 130, 140, 180, 220, 240, 300}) {
        CAPTURE(degrees);
        const double angle = degrees * std::numbers::pi / 180;
        const bool sharp = degrees<70, blunt = degrees> 110 && degrees < 135;
        CHECK(quads::may_be_good(angle) == !(sharp || blunt));
        CHECK(quads::may_be_good(angle, 1) == (degrees >= 70 && degrees <= 110));
        // A grid on two sides of the corner has rows for all sides but, at most, those of sharp corners.
        if (degrees >= 180) continue;
        PlaneGrid grid = test::plane_grid(4, 3);
        test::map(grid, [&](const Vec2& p) {
            return Vec2(p.x() + p.y() * std::cos(angle), p.y() * std::sin(angle));
        });
        const quads::PlaneQuality q = quads::measure_plane(grid.mesh, grid.region);
        CHECK(q.possible_rows >= q.good_rows);
        CHECK((q.possible_rows == q.rows) == (degrees >= 70 && degrees <= 110));
    }
}

TEST_CASE("rows and edges are judged by the size asked")
{
    for (const double height : {0.5, 0.65, 0.75, 1.0, 1.25, 1.35, 1.7}) {
        CAPTURE(height);
        PlaneGrid grid = test::plane_grid(6, 2);
        test::map(grid, [&](const Vec2& p) { return Vec2(p.x(), height * p.y()); });
        grid.region.size = [](const Vec2&) { return 1.0; };
        const quads::PlaneQuality q = quads::measure_plane(grid.mesh, grid.region);
        // The twelve long sides are judged by the height, the four short ones by the width, which is right.
        CHECK(q.good_rows == (height > 0.7 && height < 1.3 ? 16U : 4U));
        CHECK(q.edges_of_size == (height > 0.6 && height < 1.6 ? q.edges : 18U));
    }
}

TEST_CASE("rows round a hole of eight sides or more are good: its corners share what it bends")
{
    for (const int sides : {6, 7, 8, 9, 12, 24}) {
        CAPTURE(sides);
        // Two rings of quads about a hole, as high as they are wide in the middle.
        quads::PlanarQuads mesh;
        quads::PlanarRegion region;
        const double bend = 2 * std::numbers::pi / sides, across = std::cos(bend / 2);
        const std::array<double, 3> radius{1, 1 + bend, 1 + 2 * bend};
        for (const std::size_t ring : {2, 0, 1}) {
            for (int i = 0; i < sides; ++i)
                mesh.points.emplace_back(Eigen::Rotation2Dd(i * bend) * Vec2(radius[ring], 0));
        }
        region.points.assign(mesh.points.begin(), mesh.points.begin() + 2 * sides);
        region.loops.resize(2);
        for (int i = 0; i < sides; ++i) {
            region.loops[0].push_back(i);
            region.loops[1].push_back(2 * sides - 1 - i);
            const int next = (i + 1) % sides, low = sides, mid = 2 * sides;
            mesh.quads.push_back({low + i, mid + i, mid + next, low + next});
            mesh.quads.push_back({mid + i, i, next, mid + next});
        }
        region.size = [&](const Vec2&) { return bend * across; };
        CHECK(quads::find_fault(mesh, region) == "");
        const quads::PlaneQuality q = quads::measure_plane(mesh, region);
        CHECK(q.good_rows == (sides < 8 ? 0U : q.rows));
        // Half as high again as asked they are not.
        region.size = [&](const Vec2&) { return bend * across / 1.5; };
        CHECK(quads::measure_plane(mesh, region).good_rows == 0);
    }
}

TEST_CASE("points with other than four quads are counted inside, and by their angle on the boundary")
{
    for (const int sides : {3, 5, 6, 7}) {
        CAPTURE(sides);
        // A grid for every corner of a polygon, round its middle.
        PlaneGrid grid = test::plane_polygon(sides, 3);
        CHECK(quads::find_fault(grid.mesh, grid.region) == "");
        CHECK(quads::measure_plane(grid.mesh, grid.region).irregular == 1);
    }
    // A square cut out of a grid leaves corners of 270 degrees, which want three quads and have them.
    PlaneGrid corner = test::plane_corner(4);
    CHECK(quads::find_fault(corner.mesh, corner.region) == "");
    CHECK(quads::measure_plane(corner.mesh, corner.region).boundary_irregular == 0);
    // A corner of a square made as flat as a side wants two quads and has one.
    PlaneGrid flat = test::plane_grid(3, 3);
    test::map(flat, [](const Vec2& p) { return p.x() + p.y() > 0 ? p : Vec2(0.49, 0.49); });
    CHECK(quads::measure_plane(flat.mesh, flat.region).boundary_irregular == 1);
}

TEST_CASE("the sum rule tells the least irregular nodes: four in a disc, none in a ring or an L")
{
    const double right = std::numbers::pi / 2;
    const std::vector<double> four(4, right), bent{right, right, right, right, right, 3 * right};
    CHECK(quads::least_irregular({}, 1) == 4);
    CHECK(quads::least_irregular({}, 0) == 0);
    CHECK(quads::least_irregular(four, 1) == 0);
    CHECK(quads::least_irregular(bent, 1) == 0);
    // A plate with five round holes.
    CHECK(quads::least_irregular(four, -4) == 20);
    // Corners of a hexagon are nearer to one quad than to two, but not by much.
    const std::vector<double> hexagon(6, 4 * right / 3);
    CHECK(quads::least_irregular(hexagon, 1) == 2);
    CHECK(quads::least_irregular(hexagon, 1, 0.2) == 0);
    // Of a region by the angles of its loops.
    const PlaneGrid grid = test::plane_grid(5, 3);
    CHECK(quads::least_irregular(grid.region) == 0);
}

TEST_CASE("every kind of damage is found and named")
{
    const PlaneGrid good = test::plane_grid(5, 4);
    const auto fault = [&](const auto& damage) {
        PlaneGrid grid = good;
        damage(grid.mesh);
        const std::string found = quads::find_fault(grid.mesh, good.region);
        CHECK_FALSE(found.empty());
        return found;
    };
    const auto inner = static_cast<Index>(good.region.points.size());
    CHECK(fault([](auto& mesh) { mesh.points[2].x() += 1e-9; }).find("boundary points") != std::string::npos);
    CHECK(fault([](auto& mesh) { mesh.quads.pop_back(); }).find("side") != std::string::npos);
    CHECK(fault([](auto& mesh) { mesh.quads.push_back(mesh.quads[3]); }).find("side") != std::string::npos);
    CHECK(fault([](auto& mesh) { std::swap(mesh.quads[6][1], mesh.quads[6][3]); }).find("side") !=
          std::string::npos);
    CHECK(fault([](auto& mesh) { mesh.quads[6][1] = mesh.quads[6][3]; }).find("twice") != std::string::npos);
    CHECK(fault([](auto& mesh) { mesh.quads[6][1] = 1000; }).find("not a point") != std::string::npos);
    CHECK(fault([](auto& mesh) { mesh.quads[6][1] = -1; }).find("not a point") != std::string::npos);
    CHECK(fault([](auto& mesh) { mesh.points.emplace_back(0, 0); }).find("has no quad") != std::string::npos);
    CHECK(fault([&](auto& mesh) {
              mesh.points[static_cast<std::size_t>(inner)] += Vec2(1.2, 0);
          }).find("not positive") != std::string::npos);
    // A second sheet somewhere else, closed in itself, is no part of the mesh.
    CHECK(fault([](auto& mesh) {
              const auto first = static_cast<Index>(mesh.points.size());
              for (const Vec2& p : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) mesh.points.push_back(p);
              mesh.quads.push_back({first, first + 1, first + 2, first + 3});
              mesh.quads.push_back({first + 3, first + 2, first + 1, first});
          }).find("several pieces") != std::string::npos);
}
