// SPDX-License-Identifier: MIT
#include "support/cancelling.h"
#include "support/volumes.h"

#include <lacuna/matching/shared/guides.h>
#include <lacuna/matching/side_lines.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::End;
using test::Part;
using test::PrismOptions;
using test::without;

TEST_CASE("a side line rises at every corner between walls, and no two share a vertex")
{
    int combinations = 0;
    for (const int sides : {3, 4, 6}) {
        for (const int holes : {0, 2}) {
            for (const int rows : {1, 3}) {
                for (const int pieces : {1, 2}) {
                    for (const double bend : {0.0, 70.0}) {
                        const auto prism = test::prism({.sides = sides,
                                                        .height = 4,
                                                        .holes = holes,
                                                        .rows = rows,
                                                        .pieces = pieces,
                                                        .levels = 4,
                                                        .taper = 0.7,
                                                        .bend = bend});
                        const auto volume = prism.open();
                        const auto lines = matching::side_lines(volume);
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(rows);
                        CAPTURE(pieces);
                        CAPTURE(bend);
                        CHECK(lines.size() == static_cast<std::size_t>(pieces * (sides + 4 * holes)));
                        std::set<VertexId> met;
                        for (const auto& line : lines) {
                            CHECK(line.uses.size() == static_cast<std::size_t>(rows));
                            VertexId at = line.source;
                            CHECK(met.insert(at).second);
                            for (const EdgeUse& use : line.uses) {
                                CHECK(use_from(volume.model, use) == at);
                                at = use_to(volume.model, use);
                                CHECK(met.insert(at).second);
                            }
                            CHECK(at == line.target);
                        }
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " prisms");
}

TEST_CASE("side lines are the same however finely their walls are divided")
{
    for (const int sides : {3, 5}) {
        for (const int rows : {1, 2}) {
            // Beyond 2,000 points the heights that lines are told by come from another solver.
            std::vector<std::vector<std::size_t>> uses;
            for (const int levels : {4, 900}) {
                CAPTURE(levels);
                const auto prism = test::prism(
                    {.sides = sides, .height = 4, .rows = rows, .levels = levels, .taper = 0.7});
                std::vector<std::size_t>& own = uses.emplace_back();
                for (const auto& line : matching::side_lines(prism.open())) {
                    own.push_back(line.source.index());
                    for (const EdgeUse& use : line.uses) own.push_back(use.edge.index());
                    own.push_back(line.target.index());
                }
                CHECK(own.size() == static_cast<std::size_t>(sides * (rows + 2)));
            }
            CHECK(uses[0] == uses[1]);
        }
    }
}

TEST_CASE("heights rise from 0 on the source rim to 1 on the target rim, and are even on a straight prism")
{
    for (const int sides : {0, 5}) {
        for (const int rows : {1, 2}) {
            const auto volume = test::prism({.sides = sides, .height = 3, .rows = rows, .levels = 4}).open();
            const auto heights = matching::wall_heights(volume);
            std::set<Index> on_walls;
            for (const FaceId wall : volume.faces(Role::wall)) {
                for (const Triangle& t : volume.model[wall].triangles) on_walls.insert(t.begin(), t.end());
            }
            for (std::size_t p = 0; p < heights.size(); ++p) {
                const bool wall = on_walls.contains(static_cast<Index>(p));
                CHECK(std::isnan(heights[p]) != wall);
                if (wall) CHECK(heights[p] == doctest::Approx(volume.model.points[p].z() / 3).epsilon(0.02));
            }
        }
    }
}

TEST_CASE("edges between stacked walls are level, and those that rise are not")
{
    const auto volume = test::prism({.sides = 4, .rows = 3, .levels = 2}).open();
    const auto heights = matching::wall_heights(volume);
    const auto gradient = matching::height_gradient(volume, heights);
    for (std::size_t e = 0; e < volume.model.edges.size(); ++e) {
        const Edge& edge = volume.model.edges[e];
        const double rise = volume.model.at(edge.points.back()).z() -
                            volume.model.at(edge.points.front()).z();
        const double up = matching::climb(volume.model, EdgeId(e), heights, gradient);
        if (rise == 0)
            CHECK(std::abs(up) < 0.05);
        else
            CHECK(up * (rise > 0 ? 1 : -1) > 0.9);
    }
}

TEST_CASE("sections of any walls lie on their levels of a straight prism, as many points on each, and turn "
          "with a bend")
{
    int combinations = 0;
    for (const double bend : {0.0, 50.0, 120.0}) {
        for (const auto& gone : std::vector<std::vector<int>>{{}, {0}, {0, 1}, {1, 3}, {0, 1, 2}}) {
            const auto volume = test::prism({.sides = 4,
                                             .height = 5,
                                             .cuts = 2,
                                             .levels = 30,
                                             .bend = bend,
                                             .drop = without(false, false, false, gone)})
                                    .open();
            const auto sections = matching::cut_sections(volume, matching::side_lines(volume));
            CAPTURE(bend);
            CAPTURE(gone.size());
            REQUIRE(!sections.levels.front().empty());
            for (std::size_t k = 0; k < sections.levels.size(); ++k) {
                CHECK(sections.levels[k].size() == sections.levels[0].size());
                // Where on the bend the section lies, by its own points.
                Vec3 middle = Vec3::Zero();
                for (const Vec3& p : sections.levels[k])
                    middle += p / static_cast<double>(sections.levels[k].size());
                const double angle = bend * std::numbers::pi / 180;
                const double turn = bend > 0 ? std::atan2(middle.z(), 5 / angle - middle.x()) : 0;
                CHECK(sections.areas[k].normalized().dot(Vec3(std::sin(turn), 0, std::cos(turn))) > 0.99);
            }
            ++combinations;
        }
    }
    MESSAGE(combinations << " sets of walls");
}

TEST_CASE("a wall that is open at one level and closed at another has no sections in common")
{
    // A tube whose wall has a notch at the source: no edge of the notch rises to the target.
    constexpr int around = 32, rows = 8;
    healing::FacetSoup soup;
    const auto add = [&](Index a, Index b, Index c, int label) {
        soup.triangles.push_back({a, b, c});
        soup.triangle_label.push_back(label);
    };
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            soup.points.emplace_back(std::cos(angle), std::sin(angle), 0.25 * j);
        }
    }
    const auto at = [](int i, int j) { return static_cast<Index>(j * around + i % around); };
    for (const int end : {0, 1}) {
        soup.points.emplace_back(0, 0, end == 0 ? 0 : 0.25 * rows);
        const auto centre = static_cast<Index>(soup.points.size() - 1);
        for (int i = 0; i < around; ++i) {
            const Index a = at(i, end * rows), b = at(i + 1, end * rows);
            add(centre, end == 0 ? b : a, end == 0 ? a : b, end);
        }
    }
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < around; ++i) {
            if (i < 4 && j < 2) continue;
            add(at(i, j), at(i + 1, j), at(i + 1, j + 1), 2);
            add(at(i, j), at(i + 1, j + 1), at(i, j + 1), 2);
        }
    }
    const Model model = healing::split_facets(soup, {.whole_labels = true});
    REQUIRE(model.faces.size() == 3);
    const OpenVolume volume = open_volume(model,
                                          {{FaceId(Index{0})}, {FaceId(Index{1})}, {FaceId(Index{2})}});
    const auto sections = matching::cut_sections(volume, matching::side_lines(volume));
    for (const auto& level : sections.levels) CHECK(level.empty());
}

TEST_CASE("the heights of walls can be cancelled wherever they are, factorised or by multigrid")
{
    // 0.2 s is what it is to be; the rest is for builds that check themselves.
    constexpr double kAllowed = 0.5;
    constexpr int kMoments = 6;
    std::mt19937 random(17);
    for (const int levels : {115, 130, 300}) { // a little below 20,000 points, a little above, and many more
        CAPTURE(levels);
        const auto volume =
            test::prism({.sides = 4, .height = 5, .cuts = 40, .levels = levels, .bend = 60}).open();
        const auto work = [&](const RunContext& context) { matching::wall_heights(volume, {}, context); };
        const double before = test::processor_time();
        work({});
        const double whole = test::processor_time() - before;
        std::uniform_real_distribution<double> moment(0, 0.95 * whole);
        for (int i = 0; i < kMoments; ++i) {
            CAPTURE(whole);
            const auto after = test::stops_after(moment(random), test::processor_time, {}, work);
            if (after) CHECK(*after < kAllowed);
        }
    }
}
