// SPDX-License-Identifier: MIT
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/topology/shared/face_facts.h>
#include <lacuna/topology/shared/select_faces.h>

#include <doctest/doctest.h>

#include <algorithm>

using namespace lacuna;
using namespace lacuna::topology;

TEST_CASE("each condition of a selector keeps just the faces that meet it, in the model's order")
{
    for (const int sides : {3, 4, 6}) {
        CAPTURE(sides);
        const Model model = test::prism({.sides = sides, .height = 2}).model;
        const std::vector<FaceId> all = all_faces(model);
        const auto facts = face_facts(model);
        const auto check = [&](const FaceSelector& selector, const auto& is_meant) {
            std::vector<FaceId> wanted;
            std::ranges::copy_if(all, std::back_inserter(wanted), is_meant);
            CHECK(select(model, selector) == wanted);
        };
        check({}, [](FaceId) { return true; });
        for (const FaceId face : all) {
            const auto is_face = [&](FaceId f) { return f == face; };
            FaceSelector by_tag, facing, near, touching, boxed;
            by_tag.tags = {model[face].tag};
            check(by_tag, is_face);
            facing.facing = mean_normal(model, face);
            facing.normal_within = 1;
            check(facing, is_face);
            near.near = face_centroid(model, face);
            check(near, is_face);
            boxed.box = facts[face.index()].box;
            check(boxed, is_face);
            touching.touching_tag = model[face].tag;
            check(touching, [&](FaceId f) {
                return std::ranges::find(facts[face.index()].neighbours, f) !=
                       facts[face.index()].neighbours.end();
            });
            FaceSelector large;
            large.area = {face_area(model, face), std::numeric_limits<double>::infinity()};
            check(large, [&](FaceId f) { return face_area(model, f) >= face_area(model, face); });
            CHECK(edge_count(model[face]) >= 3);
        }
        FaceSelector stranger;
        stranger.touching_name = "nobody";
        CHECK(test::refusal([&] { select(model, stranger); }, {"touching"}) == "lua.no_face");
    }
}
