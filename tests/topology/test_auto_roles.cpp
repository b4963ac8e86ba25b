// SPDX-License-Identifier: MIT
#include "support/cancelling.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/topology/auto_roles.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;
using test::without;

namespace {

/// A plate with blind square pockets in its upper side: five faces each, and six of the plate.
healing::FacetSoup pocketed_plate(int count)
{
    healing::FacetSoup soup;
    const auto at = [&](double x, double y, double z) {
        soup.points.emplace_back(x, y, z);
        return static_cast<Index>(soup.points.size() - 1);
    };
    int label = 0;
    const auto add = [&](Index a, Index b, Index c, Index d, int to) {
        soup.triangles.push_back({a, b, c});
        soup.triangles.push_back({a, c, d});
        soup.triangle_label.insert(soup.triangle_label.end(), 2, to);
    };
    const int top = label++;
    const double n = 3.0 * count;
    // Cells of the upper side, three by three a pocket; the middle one is open.
    std::vector<std::vector<Index>> grid(static_cast<std::size_t>(3 * count) + 1);
    for (int i = 0; i <= 3 * count; ++i)
        for (int j = 0; j <= 3 * count; ++j) grid[static_cast<std::size_t>(i)].push_back(at(i, j, 2));
    const auto node = [&](int i, int j) {
        return grid[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    for (int i = 0; i < 3 * count; ++i) {
        for (int j = 0; j < 3 * count; ++j) {
            const std::array<Index, 4> rim{node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)};
            if (i % 3 != 1 || j % 3 != 1) {
                add(rim[0], rim[1], rim[2], rim[3], top);
                continue;
            }
            std::array<Index, 4> floor{};
            for (std::size_t k = 0; k < 4; ++k) {
                const Vec3 p = soup.points[static_cast<std::size_t>(rim[k])];
                floor[k] = at(p.x(), p.y(), 1);
            }
            for (std::size_t k = 0; k < 4; ++k)
                add(rim[k], rim[(k + 1) % 4], floor[(k + 1) % 4], floor[k], label++);
            add(floor[0], floor[1], floor[2], floor[3], label++);
        }
    }
    const std::array<Index, 4> low{at(0, 0, 0), at(n, 0, 0), at(n, n, 0), at(0, n, 0)};
    add(low[0], low[3], low[2], low[1], label++);
    // Sides as fans, so that their rims meet every node of the upper side's.
    for (int k = 0; k < 4; ++k) {
        const auto rim = [&](int i) {
            const int m = 3 * count;
            return k == 0 ? node(i, 0) : k == 1 ? node(m, i) : k == 2 ? node(m - i, m) : node(0, m - i);
        };
        const auto a = low[static_cast<std::size_t>(k)], b = low[static_cast<std::size_t>((k + 1) % 4)];
        for (int i = 0; i < 3 * count; ++i) {
            soup.triangles.push_back({a, rim(i + 1), rim(i)});
            soup.triangle_label.push_back(label);
        }
        soup.triangles.push_back({a, b, rim(3 * count)});
        soup.triangle_label.push_back(label++);
    }
    return soup;
}

} // namespace

TEST_CASE("each reading is a volume of the class it names, and the cheapest comes first")
{
    std::size_t readings = 0, found = 0;
    std::set<VolumeClass> classes;
    for (const int sides : {3, 4, 6, 0}) {
        for (const int holes : {0, 1, 3}) {
            for (const double twist : {0.0, 20.0}) {
                for (const int drop : {0, 1, 2, 3, 4, 5, 6}) {
                    if (sides == 0 && drop > 3) continue;
                    const auto prism = test::prism(
                        {.sides = sides,
                         .holes = holes,
                         .cuts = 3,
                         .levels = 3,
                         .twist = twist,
                         .drop = without(drop == 1 || drop == 3, drop == 2 || drop == 3, false,
                                         drop == 4   ? std::vector<int>{0}
                                         : drop == 5 ? std::vector<int>{0, 1}
                                         : drop == 6 ? std::vector<int>{0, 2}
                                                     : std::vector<int>{})});
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(drop);
                    const auto list = role_candidates(prism.model, all_faces(prism.model),
                                                      {.margin = std::numeric_limits<double>::infinity()});
                    for (std::size_t i = 0; i < list.size(); ++i) {
                        const RoleCandidate& reading = list[i];
                        CHECK((i == 0 || list[i - 1].cost <= reading.cost));
                        CHECK(reading.roles.source.size() + reading.roles.target.size() +
                                  reading.roles.walls.size() ==
                              prism.model.faces.size());
                        CHECK(classify(open_volume(prism.model, reading.roles)).value == reading.value);
                        const bool steps = reading.roles.source.size() + reading.roles.target.size() > 2;
                        for (const auto& part : connected_parts(prism.model, reading.roles.walls)) {
                            if (steps) break; // cut into pieces before it is swept
                            CHECK(euler_number(prism.model, part) ==
                                  2 - static_cast<long>(rims(prism.model, part).size()));
                        }
                        classes.insert(reading.value);
                        ++readings;
                    }
                    if (list.empty()) continue;
                    auto roles = list.front().roles, given = prism.roles;
                    if (roles.source.empty() && !roles.target.empty()) std::swap(roles.source, roles.target);
                    if (given.source.empty() && !given.target.empty()) std::swap(given.source, given.target);
                    if (roles.source != given.source) std::swap(given.source, given.target);
                    found += roles.source == given.source && roles.target == given.target ? 1 : 0;
                }
            }
        }
    }
    MESSAGE(readings << " readings, " << found << " volumes read as they were made");
    CHECK(classes.size() >= 5);
    CHECK(found > 100);
}

TEST_CASE("walls with a tunnel through them are no ring: a plate is not swept across its bores")
{
    const auto prism = test::prism({.sides = 4, .holes = 2, .hole_sides = 0});
    for (const RoleCandidate& reading : role_candidates(
             prism.model, all_faces(prism.model), {.margin = std::numeric_limits<double>::infinity()})) {
        CHECK(reading.roles.source.size() == 1);
        const Part& source = prism.part[reading.roles.source.front().index()];
        CHECK(source.role != Role::wall);
    }
}

TEST_CASE("readings of five hundred faces share their work")
{
    const Model model = healing::split_facets(pocketed_plate(10), {.whole_labels = true});
    REQUIRE(model.faces.size() == 506);
    const auto start = std::chrono::steady_clock::now();
    // Any two faces with one rim each that lie apart can be ends here, but then the pockets hang in walls.
    const auto list = role_candidates(model, all_faces(model));
    REQUIRE(!list.empty());
    CHECK(list.front().roles.source.size() == 1);
    CHECK(list.front().roles.target.size() == 101);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    CHECK(seconds < 5); // some 0.1 s; minutes when every reading counted its facets
}

TEST_CASE("readings of a plate with hundreds of holes are not tried for every two walls of these")
{
    std::vector<test::RoundHole> holes;
    for (int i = 0; i < 400; ++i)
        holes.push_back({Vec2(0.06 * (i % 20) - 0.57, 0.06 * std::floor(i / 20) - 0.57) / 1.2, 0.015});
    for (const bool open : {false, true}) { // a wall of the outline may be missing
        CAPTURE(open);
        const auto plate = test::prism(
            {.sides = 4,
             .height = 0.1,
             .hole_sides = 4,
             .hole_list = holes,
             .cuts = 1,
             .drop = without(false, false, false, open ? std::vector<int>{0} : std::vector<int>{})});
        const double start = test::processor_time();
        const auto list = role_candidates(plate.model, all_faces(plate.model));
        CHECK(test::processor_time() - start < 2); // some 0.1 s; minutes when every two walls were tried
        REQUIRE(!list.empty());
        CHECK(list.front().roles.walls.size() == plate.roles.walls.size());
    }
}

TEST_CASE("readings of thousands of bodies are not tried for every two of their faces")
{
    // Little blocks that touch nothing: no two faces have walls between them that join all others.
    healing::FacetSoup soup;
    const healing::FacetSoup block = test::prism({.sides = 4, .cuts = 1}).soup;
    for (int i = 0; i < 1000; ++i) {
        const auto first = static_cast<Index>(soup.points.size());
        for (const Vec3& p : block.points)
            soup.points.push_back(p + 3.0 * Vec3(i % 10, i / 10 % 10, i / 100));
        for (const Triangle& t : block.triangles)
            soup.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    const Model model = healing::split_facets(soup);
    REQUIRE(model.faces.size() == 6000);
    const double start = test::processor_time();
    role_candidates(model, all_faces(model));
    CHECK(test::processor_time() - start < 5); // some 0.2 s; minutes when every two faces were tried
}

TEST_CASE("finding roles and making a volume heed a cancel, and stop within half a second")
{
    const auto prism = test::prism({.sides = 6, .holes = 1});
    CHECK(test::heeds_cancel([&](const RunContext& context) {
        role_candidates(prism.model, all_faces(prism.model), {}, context);
    }));
    CHECK(test::heeds_cancel(
        [&](const RunContext& context) { open_volume(prism.model, prism.roles, context); }));
    const Model plate = healing::split_facets(pocketed_plate(5), {.whole_labels = true});
    const auto seconds = test::stops_within(std::chrono::milliseconds(20), [&](const RunContext& context) {
        for (;;) role_candidates(plate, all_faces(plate), {}, context);
    });
    REQUIRE(seconds);
    CHECK(*seconds < 0.5);
}
