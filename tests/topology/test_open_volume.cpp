// SPDX-License-Identifier: MIT
#include "support/edit_model.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/core/error.h>
#include <lacuna/healing/split_facets.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;
using test::refusal;
using test::without;

namespace {

/// A corner is on no wall when the walls on both its sides are gone.
bool free_corner(const std::set<int>& gone, int sides)
{
    return std::any_of(gone.begin(), gone.end(), [&](int side) { return gone.contains((side + 1) % sides); });
}

/// Table 1 said once more, from what was left out.
VolumeClass expected(bool source, bool target, const std::set<int>& gone, int sides)
{
    const auto missing = static_cast<int>(gone.size());
    if (source && target && missing == 0) return VolumeClass::closed;
    if (source && target) {
        if (missing == sides) return VolumeClass::I;
        return free_corner(gone, sides) ? VolumeClass::II : VolumeClass::III;
    }
    return source || target ? VolumeClass::IV : VolumeClass::V;
}

} // namespace

TEST_CASE("every combination of ends and walls falls into the class of Table 1, with reasons")
{
    int combinations = 0;
    for (const int sides : {3, 4, 5}) {
        for (const int holes : {0, 2}) {
            for (const bool source : {true, false}) {
                for (const bool target : {true, false}) {
                    for (unsigned bits = 0; bits < (1U << sides); ++bits) {
                        std::set<int> gone;
                        for (int k = 0; k < sides; ++k) {
                            if ((bits >> k) & 1U) gone.insert(k);
                        }
                        const bool all = static_cast<int>(gone.size()) == sides;
                        if (holes > 0 && all) continue; // then the holes' walls remain: class II, told below
                        if (!source && !target && all) continue;
                        const auto prism = test::prism(
                            {.sides = sides, .holes = holes, .hole_sides = 3, .drop = [&](const Part& part) {
                                 if (part.role == Role::source) return !source;
                                 if (part.role == Role::target) return !target;
                                 return part.loop == 0 && gone.contains(part.side);
                             }});
                        CAPTURE(sides);
                        CAPTURE(holes);
                        CAPTURE(source);
                        CAPTURE(target);
                        CAPTURE(bits);
                        const auto volume = prism.open();
                        const auto found = classify(volume);
                        CHECK(to_string(found.value) == to_string(expected(source, target, gone, sides)));
                        CHECK(found.reasons.size() >= 2);
                        CHECK(volume.turned_round == (!source && target));
                        CHECK(volume.faces(Role::source).empty() == (!source && !target));
                        CHECK((found.value == VolumeClass::closed) == found.free_loops.empty());
                        CHECK(found.wall_free_source.empty() ==
                              !((source || target) && free_corner(gone, sides)));
                        CHECK(found.wall_free_target.empty() ==
                              !(source && target && free_corner(gone, sides)));
                        ++combinations;
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " combinations classified");
}

TEST_CASE("the walls of holes count as walls")
{
    const auto prism = test::prism(
        {.sides = 4, .holes = 2, .drop = [](const Part& p) { return p.role == Role::wall && p.loop == 0; }});
    const auto found = classify(prism.open());
    CHECK(found.value == VolumeClass::II);
    CHECK(found.wall_free_source.size() == 4);
    CHECK(found.wall_free_target.size() == 4);
}

TEST_CASE(
    "an override is obeyed where the faces allow it, and refused with the reason where they contradict it")
{
    struct Case {
        const char* name;
        std::function<bool(const Part&)> drop;
        std::set<VolumeClass> allowed;
    };
    const std::vector<Case> cases{
        {"closed", nullptr, {VolumeClass::closed, VolumeClass::III}},
        {"I", without(false, false, true), {VolumeClass::I}},
        {"II", without(false, false, false, {0, 1}), {VolumeClass::II}},
        {"III", without(false, false, false, {0}), {VolumeClass::III}},
        {"IV", without(false, true, false), {VolumeClass::IV}},
        {"V", without(true, true, false), {VolumeClass::V}},
    };
    int combinations = 0;
    for (const Case& c : cases) {
        auto volume = test::prism({.sides = 4, .drop = c.drop}).open();
        for (const auto value : {VolumeClass::closed, VolumeClass::I, VolumeClass::II, VolumeClass::III,
                                 VolumeClass::IV, VolumeClass::V}) {
            CAPTURE(c.name);
            CAPTURE(std::string(to_string(value)));
            volume.override_class = value;
            ++combinations;
            if (c.allowed.contains(value)) {
                CHECK(classify(volume).value == value);
                continue;
            }
            const std::string code = refusal([&] { classify(volume); },
                                             {"class " + std::string(to_string(value)), "found"});
            CHECK(code == "topology.class_contradicted");
        }
    }
    MESSAGE(combinations << " overrides");
}

TEST_CASE("a face in two roles, a face twice, and no face at all are refused by name")
{
    const auto prism = test::prism({});
    const FaceId source = prism.roles.source.front(), wall = prism.roles.walls.front();
    Model model = prism.model;
    test::edit(model, [&](ModelBuilder& named) {
        named[source].name = "floor";
        named[wall].name = "side";
    });
    CHECK(refusal(
              [&] {
                  open_volume(model, {{source}, {source}, {}});
              },
              {"floor", "source", "target"}) == "topology.face_in_two_roles");
    CHECK(refusal(
              [&] {
                  open_volume(model, {{source}, {}, {wall, source}});
              },
              {"floor", "source", "wall"}) == "topology.face_in_two_roles");
    CHECK(refusal(
              [&] {
                  open_volume(model, {{source}, {}, {wall, wall}});
              },
              {"side", "twice", "wall"}) == "topology.face_twice");
    CHECK(refusal(
              [&] {
                  open_volume(model, {{source, source}, {}, {}});
              },
              {"floor", "twice", "source"}) == "topology.face_twice");
    CHECK(refusal([&] { open_volume(model, {}); }, {"no faces"}) == "topology.no_faces");
}

TEST_CASE("a wall that touches neither end is refused by name")
{
    const auto first = test::prism({.drop = without(false, false, false, {2})});
    auto soup = first.soup;
    const auto base = static_cast<Index>(soup.points.size());
    for (const Vec3& p : {Vec3(9, 0, 0), Vec3(10, 0, 0), Vec3(9, 1, 0)}) soup.points.push_back(p);
    soup.triangles.push_back({base, base + 1, base + 2});
    soup.triangle_label.push_back(static_cast<int>(soup.label_name.size()));
    soup.label_name.push_back("astray");
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles = first.roles;
    roles.walls.emplace_back(model.faces.size() - 1);
    CHECK(refusal([&] { open_volume(model, roles); }, {"astray", "wall"}) == "topology.wall_apart");
    // It is far from everything: no tolerance would join it.
    try {
        open_volume(model, roles);
    } catch (const Error& error) {
        CHECK(std::string(error.what()).find("tolerance") == std::string::npos);
    }
}

TEST_CASE("a gap beside a wall is named with its width and with a tolerance that closes it")
{
    for (const double gap : {1e-5, 3e-4, 2e-3}) {
        CAPTURE(gap);
        const auto whole = test::prism({});
        auto soup = whole.soup;
        // One wall, moved off by the gap.
        const int wall = static_cast<int>(whole.roles.walls.front().index());
        std::map<Index, Index> moved;
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            if (soup.triangle_label[t] != wall) continue;
            for (Index& p : soup.triangles[t]) {
                const auto [found, fresh] = moved.try_emplace(p, static_cast<Index>(soup.points.size()));
                if (fresh)
                    soup.points.push_back(soup.points[static_cast<std::size_t>(p)] +
                                          gap * Vec3(0.6, 0.64, 0.48));
                p = found->second;
            }
        }
        healing::SplitOptions split;
        split.whole_labels = true;
        const Model model = healing::split_facets(soup, split);
        std::string message;
        try {
            open_volume(model, whole.roles);
        } catch (const InvalidInput& error) {
            CHECK(error.code() == "topology.wall_apart");
            CHECK(error.message().found() == std::vector<MessageValue>{model.tolerance});
            message = error.message().remedy();
        }
        CAPTURE(message);
        const std::size_t at = message.find("tolerance = ");
        REQUIRE(at != std::string::npos);
        split.tolerance = std::stod(message.substr(at + 12));
        CHECK(split.tolerance >= gap);
        CHECK(split.tolerance <= 1.2 * gap);
        const Model joined = healing::split_facets(soup, split);
        CHECK(classify(open_volume(joined, whole.roles)).value == VolumeClass::closed);
    }
}

TEST_CASE("an open volume holds only what its faces use, and the model it came from is left alone")
{
    const auto prism = test::prism({.sides = 6, .holes = 2});
    const Roles roles{prism.roles.source, {}, {prism.roles.walls[0], prism.roles.walls[1]}};
    const auto volume = open_volume(prism.model, roles);
    REQUIRE(volume.model.faces.size() == 3);
    std::set<Index> used;
    for (const Face& face : volume.model.faces) {
        for (const Triangle& t : face.triangles) used.insert(t.begin(), t.end());
    }
    CHECK(used.size() == volume.model.points.size());
    for (std::size_t e = 0; e < volume.model.edges.size(); ++e)
        CHECK(!volume.model.uses_of_edge(EdgeId(e)).empty());
    for (const Edge& edge : volume.model.edges) {
        CHECK(volume.model[edge.from].point == edge.points.front());
        CHECK(volume.model[edge.to].point == edge.points.back());
    }
    CHECK(volume.model[FaceId(0)].tag == prism.model[roles.source.front()].tag);
    CHECK(face_area(volume.model, FaceId(1)) == doctest::Approx(face_area(prism.model, roles.walls[0])));
}
