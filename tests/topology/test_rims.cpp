// SPDX-License-Identifier: MIT
#include "support/volumes.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;

namespace {

/// Faces of an n × m board of unit squares in the plane, all looking up.
Model board(int n, int m, const std::vector<std::pair<int, int>>& squares)
{
    healing::FacetSoup soup;
    for (int j = 0; j <= m; ++j) {
        for (int i = 0; i <= n; ++i) soup.points.emplace_back(i, j, 0);
    }
    for (const auto& [i, j] : squares) {
        const Index a = j * (n + 1) + i;
        soup.quads.push_back({a, a + 1, a + n + 2, a + n + 1});
        soup.quad_label.push_back(static_cast<int>(soup.quad_label.size()));
    }
    return healing::split_facets(soup);
}

/// Each rim is a closed walk, and together they use exactly the edges the set uses once, the faces on the
/// left.
void check_rims(const Model& model, const std::vector<FaceId>& faces)
{
    std::map<EdgeId, std::vector<bool>> uses;
    for (const FaceId face : faces) {
        for (const Loop& loop : model[face].loops) {
            for (const EdgeUse& use : loop.uses) uses[use.edge].push_back(use.reversed);
        }
    }
    std::map<EdgeId, bool> border;
    for (const auto& [edge, list] : uses) {
        if (list.size() == 1) border[edge] = list.front();
    }
    for (const Rim& rim : rims(model, faces)) {
        for (std::size_t i = 0; i < rim.uses.size(); ++i) {
            CHECK(use_to(model, rim.uses[i]) == use_from(model, rim.uses[(i + 1) % rim.uses.size()]));
            const auto found = border.find(rim.uses[i].edge);
            REQUIRE(found != border.end());
            CHECK(found->second == rim.uses[i].reversed);
            border.erase(found);
        }
    }
    CHECK(border.empty());
}

} // namespace

TEST_CASE("rims of every set of squares on a board use each border edge once, in closed walks")
{
    int combinations = 0;
    for (unsigned bits = 1; bits < (1U << 12); bits += 3) {
        std::vector<std::pair<int, int>> squares;
        for (int k = 0; k < 12; ++k) {
            if ((bits >> k) & 1U) squares.emplace_back(k % 4, k / 4);
        }
        const Model model = board(4, 3, squares);
        CAPTURE(bits);
        check_rims(model, all_faces(model));
        ++combinations;
    }
    MESSAGE(combinations << " sets of squares");
}

TEST_CASE("faces that meet in a vertex alone have a rim each")
{
    const Model diagonal = board(3, 3, {{0, 0}, {1, 1}, {2, 2}});
    const auto three = rims(diagonal, all_faces(diagonal));
    REQUIRE(three.size() == 3);
    for (const Rim& rim : three) CHECK(rim.uses.size() == 4);
    // A ring of eight squares: the hole is a rim of its own; without two opposite corners still one outside.
    const Model ring = board(3, 3, {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}});
    const auto two = rims(ring, all_faces(ring));
    REQUIRE(two.size() == 2);
    CHECK(two[0].uses.size() == 12);
    CHECK(two[1].uses.size() == 4);
}

TEST_CASE("a whole skin has no rim, and its parts have complementary ones")
{
    const auto prism = test::prism({.sides = 5, .holes = 2, .hole_sides = 0, .rows = 2});
    Model model = prism.model;
    orient_consistently(model);
    CHECK(rims(model, all_faces(model)).empty());
    for (unsigned bits = 1; bits < 200; ++bits) {
        std::vector<FaceId> in, out;
        for (std::size_t f = 0; f < model.faces.size(); ++f)
            ((bits >> (f % 8)) & 1U ? in : out).emplace_back(f);
        std::map<EdgeId, bool> inside;
        for (const Rim& rim : rims(model, in)) {
            for (const EdgeUse& use : rim.uses) inside[use.edge] = use.reversed;
        }
        std::size_t count = 0;
        for (const Rim& rim : rims(model, out)) {
            for (const EdgeUse& use : rim.uses) {
                ++count;
                REQUIRE(inside.contains(use.edge));
                CHECK(inside.at(use.edge) != use.reversed);
            }
        }
        CHECK(count == inside.size());
    }
}

TEST_CASE("a seam is no rim of its face")
{
    auto prism = test::prism({.sides = 0});
    const FaceId wall = prism.face({Role::wall, 0, 0, 0, 0});
    const auto before = rims(prism.model, {wall});
    test::add_seam(prism.model, wall);
    const auto after = rims(prism.model, {wall});
    REQUIRE(before.size() == 2);
    REQUIRE(after.size() == 2);
    for (const Rim& rim : after) {
        CHECK(rim.uses.size() == 1);
        CHECK(rim.uses.front().edge != EdgeId(prism.model.edges.size() - 1));
    }
}

TEST_CASE("free edges are those used once, and free loops walk each of them once")
{
    int combinations = 0;
    for (const int sides : {0, 3, 4, 6}) {
        for (const int holes : {0, 1, 4}) {
            for (unsigned bits = 0; bits < 32; ++bits) {
                const auto drop = [&](const Part& part) {
                    if (part.role == Role::source) return (bits & 1U) != 0;
                    if (part.role == Role::target) return (bits & 2U) != 0;
                    return ((bits >> (2 + (part.side + part.loop) % 3)) & 1U) != 0;
                };
                const auto prism = test::prism({.sides = sides, .holes = holes, .rows = 2, .drop = drop});
                if (prism.model.faces.empty()) continue;
                if (prism.roles.source.empty() && prism.roles.target.empty() && prism.roles.walls.empty())
                    continue;
                const auto volume = prism.open();
                std::set<EdgeId> walked;
                for (const Rim& rim : free_loops(volume)) {
                    for (const EdgeUse& use : rim.uses) CHECK(walked.insert(use.edge).second);
                }
                const auto free = free_edges(volume);
                CHECK(std::set<EdgeId>(free.begin(), free.end()) == walked);
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " open volumes");
}
