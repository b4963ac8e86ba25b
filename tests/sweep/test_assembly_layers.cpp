// SPDX-License-Identifier: MIT
#include "support/assemblies.h"
#include "support/dice.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/surface/shared/boundary_layers.h>

#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweptAssembly;
using test::Brick;
using test::brick;
using test::Members;

namespace {

surface::BoundaryLayer rows_on(int side, double first, double growth, int count)
{
    surface::BoundaryLayer layer;
    layer.walls.names = {"side_" + std::to_string(side)};
    layer.first = first;
    layer.growth = growth;
    layer.count = count;
    return layer;
}

/// Whether nodes of a part stand at every row over a flat face across an axis, and none between.
void check_rows(const mesh::HexMesh& mesh, const surface::BoundaryLayer& layer, int side, const Brick& of)
{
    const int n = side / 2;
    std::set<long> heights;
    for (const Vec3& p : mesh.nodes) {
        const double height = side % 2 == 0 ? p[n] - of.low[n] : of.high[n] - p[n];
        heights.insert(std::lround(height * 1e6));
    }
    const std::vector<double> rows = surface::row_heights(layer);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double thick = rows[i] - (i > 0 ? rows[i - 1] : 0);
        const auto near = [&](long h) {
            return std::abs(static_cast<double>(h) * 1e-6 - rows[i]) < 0.02 * thick;
        };
        CHECK(std::any_of(heights.begin(), heights.end(), near));
    }
    const auto first = static_cast<long>(std::lround(rows.front() * 0.97e6));
    CHECK(std::none_of(heights.begin(), heights.end(), [&](long h) { return h > 1 && h < first; }));
}

} // namespace

TEST_CASE("rows along walls and ends end on edges that several volumes share: one mesh with the rows of each")
{
    int meshed = 0;
    test::Refusals refused;
    for (unsigned seed = 1; seed <= 120; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        Members members;
        std::vector<Brick> bricks;
        std::vector<std::vector<std::pair<int, surface::BoundaryLayer>>> layers;
        double volume = 0;
        // A row or a square of blocks; the same walls or ends of some of them have rows.
        const int across = dice.whole(1, 3), along = across == 1 ? dice.whole(2, 3) : dice.whole(1, 2);
        const int axis = dice.whole(0, 2);
        const bool one_axis = dice.chance(0.7), all = dice.chance(0.5);
        const double first = dice.between(0.01, 0.03), growth = dice.between(1.0, 1.6);
        const int count = dice.whole(1, 4), side = dice.whole(0, 5);
        for (int i = 0; i < across; ++i) {
            for (int j = 0; j < along; ++j) {
                Brick b{.low = Vec3(i, j * 1.2, 0), .high = Vec3(i + 1, (j + 1) * 1.2, 1.5)};
                b.axis = one_axis ? axis : dice.whole(0, 2);
                b.cuts = dice.whole(1, 2);
                bricks.push_back(b);
                members.add(brick(b), dice.between(0.25, 0.5));
                volume += (b.high - b.low).prod();
                layers.emplace_back();
                if (!all && !dice.chance(0.5)) continue;
                layers.back().emplace_back(side, rows_on(side, first, growth, count));
                if (dice.chance(0.3)) {
                    const int other = (side + 2) % 6; // round the corner
                    layers.back().emplace_back(other, rows_on(other, first, growth, count));
                }
                for (const auto& [where, layer] : layers.back())
                    members.options.back().boundary_layers.push_back(layer);
            }
        }
        try {
            const SweptAssembly whole = sweep::sweep_assembly(members.list());
            test::check_assembly(whole, volume);
            for (std::size_t m = 0; m < bricks.size(); ++m)
                for (const auto& [where, layer] : layers[m])
                    check_rows(whole.parts[m].mesh, layer, where, bricks[m]);
            ++meshed;
        } catch (const Error& error) {
            refused.add(seed, error);
        }
    }
    MESSAGE(meshed << " meshed, refused:" << refused.in_words());
    CHECK(meshed >= 115);
}

TEST_CASE("rows that end on one edge of two volumes and are unlike are refused, both named")
{
    Members members;
    members.add(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), 0.25);
    members.add(brick({.low = {1, 0, 0}, .high = {2, 1, 1}}), 0.25);
    members.options[0].boundary_layers = {rows_on(2, 0.02, 1.5, 3)};
    members.options[1].boundary_layers = {rows_on(2, 0.03, 1.5, 3)};
    CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); },
                        {"part_1", "part_2", "side_2", "same table of 'boundary_layers'"}) ==
          "assembly.layers_differ");
    members.options[1].boundary_layers = members.options[0].boundary_layers;
    test::check_assembly(sweep::sweep_assembly(members.list()), 2);
}

TEST_CASE("more rows on an edge than a neighbour's layers leave sides for are refused, and the number named")
{
    Members members;
    members.add(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), 0.25);
    members.add(brick({.low = {1, 0, 0}, .high = {2, 1, 1}, .axis = 1}), 0.25, 3);
    members.options[0].boundary_layers = {rows_on(2, 0.02, 1.5, 4)};
    CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); },
                        {"part_1", "side_2", "at least 5 sides", "3"}) == "assembly.layers_rows");
    members.options[1].layers.count = 6;
    test::check_assembly(sweep::sweep_assembly(members.list()), 2);
}

TEST_CASE("rows of prisms of any section end on the wall that two of them share")
{
    int meshed = 0, refused = 0;
    for (const double angle : {60.0, 75.0, 90.0, 110.0}) {
        for (const double taper : {1.0, 0.8}) {
            CAPTURE(angle);
            CAPTURE(taper);
            // Two halves of a trapezium that meet at x = 0, and lean on their outer sides.
            const double lean = 1 / std::tan(angle * 3.14159265358979 / 180);
            Members members;
            for (const double way : {-1.0, 1.0}) {
                Brick half{.low = {0, 0, 0}, .high = {2, 1.5, 1}, .cuts = 4};
                half.map = [=](const Vec3& p) {
                    const double shrink = 1 + (taper - 1) * p.z();
                    return Vec3(way * (p.x() + 0.5 * p.x() * lean * p.y()) * shrink, p.y() * shrink, p.z());
                };
                members.add(brick(half), 0.3);
                members.options.back().boundary_layers = {rows_on(2, 0.03, 1.3, 3)};
            }
            try {
                const SweptAssembly whole = sweep::sweep_assembly(members.list());
                double sealed = 0;
                for (const auto& part : whole.parts) sealed += part.fidelity.sealed_volume;
                test::check_assembly(whole, sealed, 1e-3);
                ++meshed;
            } catch (const Error& error) {
                ++refused;
                MESSAGE(std::string(error.what()));
            }
        }
    }
    MESSAGE(meshed << " meshed, " << refused << " refused");
    CHECK(meshed >= 6);
}
