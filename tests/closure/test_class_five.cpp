// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/edit_model.h"

#include <lacuna/closure/detail/class_five.h>
#include <lacuna/healing/split_facets.h>

#include <algorithm>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;
using test::PrismOptions;

namespace {

/// A prism's walls put beside or within another's.
OpenVolume together(const std::vector<std::pair<PrismOptions, Vec3>>& prisms)
{
    healing::FacetSoup soup;
    int label = 0;
    for (const auto& [options, shift] : prisms) {
        const auto more = test::prism(options).soup;
        const auto base = static_cast<Index>(soup.points.size());
        for (const Vec3& p : more.points) soup.points.push_back(p + shift);
        const int first = label;
        for (std::size_t t = 0; t < more.triangles.size(); ++t) {
            const Triangle& c = more.triangles[t];
            soup.triangles.push_back({c[0] + base, c[1] + base, c[2] + base});
            soup.triangle_label.push_back(first + more.triangle_label[t]);
            label = std::max(label, first + more.triangle_label[t] + 1);
        }
    }
    for (int l = 0; l < label; ++l) soup.label_name.push_back("w" + std::to_string(l));
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) roles.walls.emplace_back(f);
    return open_volume(model, roles);
}

const auto kWallsAlone = test::without(true, true, false);

} // namespace

TEST_CASE(
    "the loops of walls alone are grouped by the end they lie at, whatever the facets' order and direction")
{
    int combinations = 0;
    for (const int holes : {0, 1, 4}) {
        for (const double bend : {0.0, 90.0, 170.0}) {
            for (const double taper : {1.0, 0.5}) {
                for (unsigned seed = 0; seed < 4; ++seed) {
                    const PrismOptions options{.sides = 5,
                                               .height = 6,
                                               .holes = holes,
                                               .levels = 12,
                                               .taper = taper,
                                               .bend = bend,
                                               .drop = kWallsAlone};
                    const auto prism = test::prism(options);
                    healing::SplitOptions split;
                    split.whole_labels = true;
                    const Model model = healing::split_facets(test::scrambled_facets(prism.soup, seed),
                                                              split);
                    Roles roles;
                    for (std::size_t f = 0; f < model.faces.size(); ++f) roles.walls.emplace_back(f);
                    auto volume = open_volume(model, roles);
                    CAPTURE(holes);
                    CAPTURE(bend);
                    CAPTURE(taper);
                    CAPTURE(seed);
                    const auto ends = closure::group_loops(volume);
                    REQUIRE(ends.source.size() == static_cast<std::size_t>(holes) + 1);
                    REQUIRE(ends.target.size() == ends.source.size());
                    // The source's loops all lie in the plane z = 0, or all off it.
                    std::set<bool> low;
                    for (const Loop& loop : ends.source) {
                        for (const EdgeUse& use : loop.uses)
                            low.insert(std::abs(volume.model.at(volume.model[use.edge].points.front()).z()) <
                                       1e-9);
                    }
                    CHECK(low.size() == 1);
                    test::seal(volume);
                    test::check_sealed(volume);
                    CHECK(closure::enclosed_volume(volume) ==
                          doctest::Approx(prism.facet_volume).epsilon(1e-6));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " sets of walls");
}

TEST_CASE(
    "a floor round a narrower bore is part of the end it lies in, whichever that is, and not of the walls")
{
    for (const int sides : {0, 4, 7}) {
        for (const int hole_sides : {0, 5}) {
            for (const double bend : {0.0, 80.0}) {
                for (const double taper : {0.6, 1.0, 1.5}) {
                    CAPTURE(sides);
                    CAPTURE(hole_sides);
                    CAPTURE(bend);
                    CAPTURE(taper);
                    PrismOptions options{.sides = sides,
                                         .height = 3,
                                         .hole_sides = hole_sides,
                                         .levels = 8,
                                         .taper = taper,
                                         .bend = bend};
                    const double volume_within = test::prism(options).facet_volume;
                    options.holes = 1;
                    options.drop = [](const Part& part) {
                        return part.role == Role::source || (part.role == Role::wall && part.loop > 0);
                    };
                    const test::Prism prism = test::prism(options);
                    Roles roles;
                    for (std::size_t f = 0; f < prism.model.faces.size(); ++f) roles.walls.emplace_back(f);
                    OpenVolume volume = open_volume(prism.model, roles);
                    const FaceId floor = prism.roles.target.front();
                    CHECK(classify(volume).value == VolumeClass::V);
                    const closure::Closure closed = test::seal(volume);
                    test::check_sealed(volume);
                    CHECK(closure::enclosed_volume(volume) == doctest::Approx(volume_within).epsilon(1e-9));
                    CHECK(volume.role[floor.index()] != Role::wall);
                    CHECK(volume.faces(volume.role[floor.index()]).size() == 2);
                    CHECK(volume.faces(Role::wall).size() == prism.model.faces.size() - 1);
                    CHECK(closed.notes.size() == 1);
                }
            }
        }
    }
}

TEST_CASE("walls that leave an odd number of loops are refused, and the walls named")
{
    // Two tubes, one of them with a lid: three free loops.
    auto volume = together(
        {{{.sides = 6, .radius = 2, .drop = kWallsAlone}, Vec3(0, 0, 0)},
         {{.sides = 4, .radius = 0.5, .drop = test::without(true, false, false)}, Vec3(0, 0, 0)}});
    const std::string code = test::refusal([&] { test::seal(volume); }, {"1 free loop", "face "});
    CHECK(code == "closure.tube_loops");
    // A tube with a gap in its wall has one loop.
    auto gap = together({{{.sides = 6, .drop = test::without(true, true, false, {2})}, Vec3(0, 0, 0)}});
    CHECK(test::refusal([&] { test::seal(gap); }, {"1 free loop", "face "}) == "closure.tube_loops");
    // And one with a window three.
    auto window = together(
        {{{.sides = 6,
           .rows = 3,
           .drop = [](const Part& p) { return p.role != Role::wall || (p.row == 1 && p.side == 0); }},
          Vec3(0, 0, 0)}});
    CHECK(test::refusal([&] { test::seal(window); }, {"3 free loops", "face "}) == "closure.tube_loops");
}

TEST_CASE("tubes side by side, and tubes nested twice, are several volumes and are refused")
{
    auto beside = together({{{.sides = 4, .drop = kWallsAlone}, Vec3(0, 0, 0)},
                            {{.sides = 4, .radius = 0.5, .drop = kWallsAlone}, Vec3(5, 0, 0)}});
    CHECK(test::refusal([&] { test::seal(beside); }, {"beside"}) == "closure.nested_loops");
    auto nested = together({{{.sides = 4, .radius = 3, .drop = kWallsAlone}, Vec3(0, 0, 0)},
                            {{.sides = 4, .radius = 2, .drop = kWallsAlone}, Vec3(0, 0, 0)},
                            {{.sides = 4, .radius = 1, .drop = kWallsAlone}, Vec3(0, 0, 0)}});
    CHECK(test::refusal([&] { test::seal(nested); }, {"nested"}) == "closure.nested_loops");
}

TEST_CASE("a tube as near to one end as to the other is refused")
{
    // The inner tube lies across, its two loops at the same height.
    PrismOptions inner{.sides = 4, .radius = 0.2, .height = 1, .drop = kWallsAlone};
    auto volume = together({{{.sides = 6, .radius = 3, .height = 2, .drop = kWallsAlone}, Vec3(0, 0, 0)},
                            {inner, Vec3(0, 0, 0.5)}});
    std::vector<FaceId> all;
    for (std::size_t f = 0; f < volume.model.faces.size(); ++f) all.emplace_back(f);
    test::edit(volume.model, [](ModelBuilder& model) {
        for (Vec3& p : model.points)
            if (p.head<2>().norm() < 0.5) p = Vec3(p.z() - 1, p.y(), p.x() + 1);
    });
    const std::string code = test::refusal([&] { test::seal(volume); }, {"name the source"});
    CHECK(code == "closure.ambiguous_loops");
}

TEST_CASE("inner tubes of other heights and shapes than the outer one still find their ends")
{
    for (const double inner_height : {1.0, 2.0, 3.0}) {
        for (const int sides : {0, 3, 4}) {
            auto volume = together(
                {{{.sides = 6, .radius = 3, .height = 2, .drop = kWallsAlone}, Vec3(0, 0, 0)},
                 {{.sides = sides, .radius = 1, .height = inner_height, .drop = kWallsAlone},
                  Vec3(0, 0, 1 - inner_height / 2)}});
            CAPTURE(inner_height);
            CAPTURE(sides);
            test::seal(volume, {.cap = closure::Cap::flat});
            test::check_sealed(volume);
        }
    }
}
