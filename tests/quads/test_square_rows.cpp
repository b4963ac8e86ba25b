// SPDX-License-Identifier: MIT
#include "plane_grids.h"

#include <lacuna/quads/detail/mesh_symmetry.h>
#include <lacuna/quads/detail/square_rows.h>
#include <lacuna/quads/shared/measure_plane.h>

#include <doctest/doctest.h>

#include <algorithm>

using namespace lacuna;

TEST_CASE("rows are squared where nodes stand badly, and no quad gets worse than the worst")
{
    std::size_t gained = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        for (test::PlaneGrid grid :
             {test::plane_grid(9, 7), test::plane_corner(4), test::plane_polygon(5, 4)}) {
            CAPTURE(seed);
            double side = (grid.region.points[1] - grid.region.points[0]).norm();
            grid.region.size = [side](const Vec2&) { return side; };
            test::shake(grid, 0.25 * side, seed);
            if (!quads::find_fault(grid.mesh, grid.region).empty()) continue;
            const quads::PlaneQuality before = quads::measure_plane(grid.mesh, grid.region);
            quads::paving::square_rows(grid.mesh, grid.region);
            const quads::PlaneQuality after = quads::measure_plane(grid.mesh, grid.region);
            CHECK(quads::find_fault(grid.mesh, grid.region) == "");
            CHECK(after.min_scaled_jacobian >= before.min_scaled_jacobian);
            const bool sizes_rose = after.edges_of_size > before.edges_of_size;
            CHECK((after.good_rows >= before.good_rows || sizes_rose));
            if (after.good_rows > before.good_rows) gained += after.good_rows - before.good_rows;
        }
    }
    CHECK(gained > 100);
}

TEST_CASE("a mesh whose rows are good stays as it is")
{
    test::PlaneGrid grid = test::plane_grid(6, 5);
    test::shake(grid, 0.02, 3);
    const std::vector<Vec2> before = grid.mesh.points;
    quads::paving::square_rows(grid.mesh, grid.region);
    CHECK(grid.mesh.points == before);
}

TEST_CASE(
    "symmetric quads stay symmetric while their rows are squared, and no quad gets worse than the worst")
{
    std::size_t gained = 0;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        for (test::PlaneGrid grid : {test::plane_grid(8, 6), test::plane_grid(7, 7), test::plane_corner(3),
                                     test::plane_polygon(5, 4), test::plane_polygon(6, 3)}) {
            CAPTURE(seed);
            const double side = (grid.region.points[1] - grid.region.points[0]).norm();
            grid.region.size = [side](const Vec2&) { return side; };
            const std::vector<quads::Symmetry> symmetries = quads::mesh_symmetries(grid.mesh, grid.region);
            REQUIRE(!symmetries.empty());
            test::shake(grid, 0.7 * side, seed);
            const std::size_t fixed = grid.region.points.size();
            if (quads::symmetrise(grid.mesh, fixed, symmetries) == 1 ||
                !quads::find_fault(grid.mesh, grid.region).empty())
                continue;
            const quads::PlaneQuality before = quads::measure_plane(grid.mesh, grid.region);
            quads::paving::square_rows(grid.mesh, grid.region, symmetries);
            const quads::PlaneQuality after = quads::measure_plane(grid.mesh, grid.region);
            CHECK(quads::find_fault(grid.mesh, grid.region) == "");
            CHECK(after.min_scaled_jacobian >= before.min_scaled_jacobian - 1e-9);
            for (const quads::Symmetry& symmetry : symmetries) {
                for (std::size_t p = 0; p < grid.mesh.points.size(); ++p) {
                    const Vec2 image = grid.mesh.points[static_cast<std::size_t>(symmetry.to[p])];
                    CHECK((symmetry.map(grid.mesh.points[p]) - image).norm() < 1e-9 * side);
                }
            }
            if (after.good_rows > before.good_rows) gained += after.good_rows - before.good_rows;
        }
    }
    CHECK(gained > 20);
}

TEST_CASE("sides are brought to the size asked where fewer than promised are, and promised shares are kept")
{
    int more = 0, all = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        for (test::PlaneGrid grid : {test::plane_grid(9, 7), test::plane_polygon(5, 4)}) {
            CAPTURE(seed);
            const double side = (grid.region.points[1] - grid.region.points[0]).norm();
            grid.region.size = [side](const Vec2&) { return side; };
            test::shake(grid, 0.4 * side, seed);
            if (!quads::find_fault(grid.mesh, grid.region).empty()) continue;
            const quads::PlaneQuality before = quads::measure_plane(grid.mesh, grid.region);
            quads::paving::square_rows(grid.mesh, grid.region);
            const quads::PlaneQuality after = quads::measure_plane(grid.mesh, grid.region);
            CHECK(quads::find_fault(grid.mesh, grid.region) == "");
            if (before.size_share() >= 0.95) CHECK(after.size_share() >= 0.95);
            if (before.size_share() >= 0.95) continue;
            ++all;
            more += after.size_share() > before.size_share() ? 1 : 0;
        }
    }
    MESSAGE(more << " of " << all << " have more sides of the size asked");
    CHECK(all > 3);
    CHECK(more >= all - all / 5);
}
