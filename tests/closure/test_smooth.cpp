// SPDX-License-Identifier: MIT
#include "closure/sealing_checks.h"
#include "support/dice.h"
#include "support/whole_families.h"

#include <cmath>
#include <numbers>

using namespace lacuna;
using namespace lacuna::topology;
using closure::EdgeShape;
using test::End;
using test::Part;
using test::PrismOptions;
using test::without;

namespace {

constexpr double kHeight = 5;

PrismOptions bent(int sides, double bend)
{
    return {.sides = sides, .height = kHeight, .cuts = 4, .levels = 48, .bend = bend};
}

/// How far points stray from arcs about the axis of a bend, as a share of the arcs' radii.
double off_arc(const Model& model, EdgeId edge, double bend)
{
    const Vec3 centre(kHeight / (bend * std::numbers::pi / 180), 0, 0);
    const auto radius = [&](Index p) {
        const Vec3 r = model.at(p) - centre;
        return std::hypot(r.x(), r.z());
    };
    const double wanted = radius(model[edge].points.front());
    double worst = 0;
    for (const Index p : model[edge].points) worst = std::max(worst, std::abs(radius(p) / wanted - 1));
    return worst;
}

int tag_at(const OpenVolume& volume, const Vec3& place)
{
    for (const Vertex& vertex : volume.model.vertices) {
        if ((volume.model.at(vertex.point) - place).norm() < 1e-9) return vertex.tag;
    }
    return 0;
}

} // namespace

TEST_CASE("smooth void edges of a bend without walls run as arcs and close to the volume of the whole")
{
    int combinations = 0;
    test::MembersToRun run(5);
    for (const int sides : {0, 3, 4, 6}) {
        for (const int holes : {0, 1, 2}) {
            for (const int hole_sides : {0, 4}) {
                for (const double bend : {30.0, 60.0, 90.0, 120.0}) {
                    if (!run.next()) continue;
                    PrismOptions options = bent(sides, bend);
                    options.holes = holes;
                    options.hole_sides = hole_sides;
                    options.drop = without(false, false, true);
                    const auto prism = test::prism(options);
                    auto volume = prism.open();
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(hole_sides);
                    CAPTURE(bend);
                    const auto closed = test::seal(volume, {EdgeShape::smooth});
                    test::check_sealed(volume);
                    CHECK(closure::enclosed_volume(volume) ==
                          doctest::Approx(prism.facet_volume).epsilon(0.01));
                    for (const EdgeId edge : closed.void_edges)
                        CHECK(off_arc(volume.model, edge, bend) < 0.01);
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " bends");
}

TEST_CASE("left to itself, a bend without walls is closed as a bend past 100 degrees, and what else may be "
          "meant is "
          "said past 20")
{
    test::MembersToRun run(5);
    for (const int sides : {0, 4, 6}) {
        for (const int holes : {0, 1}) {
            for (const double bend : {0.0, 10.0, 45.0, 90.0, 110.0, 120.0}) {
                if (!run.next()) continue;
                PrismOptions options = bent(sides, bend);
                options.holes = holes;
                options.drop = without(false, false, true);
                const auto prism = test::prism(options);
                auto volume = prism.open();
                CAPTURE(sides);
                CAPTURE(holes);
                CAPTURE(bend);
                const auto closed = test::seal(volume);
                test::check_sealed(volume);
                CHECK(closed.notes.size() == (bend > 20 ? 1 : 0));
                if (bend > 100)
                    CHECK(closure::enclosed_volume(volume) ==
                          doctest::Approx(prism.facet_volume).epsilon(0.01));
                else
                    for (const EdgeId edge : closed.void_edges) CHECK(volume.model[edge].points.size() < 64);
            }
        }
    }
}

TEST_CASE("smooth void edges leave the ends as the walls beside them do")
{
    int combinations = 0;
    for (const auto& gone : std::vector<std::vector<int>>{{0, 1}, {1, 2}, {0, 1, 2}, {1, 2, 3}}) {
        for (const double bend : {30.0, 90.0}) {
            PrismOptions options = bent(4, bend);
            options.drop = without(false, false, false, gone);
            const auto prism = test::prism(options);
            auto volume = prism.open();
            CAPTURE(bend);
            CAPTURE(gone.size());
            const auto closed = test::seal(volume, {EdgeShape::smooth});
            test::check_sealed(volume);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(0.02));
            for (const EdgeId edge : closed.void_edges) CHECK(off_arc(volume.model, edge, bend) < 0.01);
            ++combinations;
        }
        for (const double taper : {1.0, 0.6}) { // oblique walls: not along the ends' normals
            const auto prism = test::prism({.sides = 4,
                                            .height = 4,
                                            .cuts = 3,
                                            .levels = 8,
                                            .taper = taper,
                                            .drop = without(false, false, false, gone)});
            auto volume = prism.open();
            test::seal(volume, {EdgeShape::smooth});
            test::check_sealed(volume);
            CAPTURE(taper);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(0.01));
            ++combinations;
        }
    }
    MESSAGE(combinations << " volumes with some walls");
}

TEST_CASE("smooth void edges go on from the stubs that stand at the ends")
{
    for (const double bend : {30.0, 90.0, 120.0}) {
        PrismOptions options = bent(4, bend);
        options.rows = 4;
        options.levels = 12;
        options.drop = [](const Part& p) {
            return p.role == Role::wall && !(p.row == 0 && p.side < 2) && !(p.row == 3 && p.side >= 2);
        };
        const auto prism = test::prism(options);
        auto volume = prism.open();
        CAPTURE(bend);
        const auto closed = test::seal(volume, {EdgeShape::smooth});
        test::check_sealed(volume);
        CHECK(closed.void_edges.size() == 4);
        CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(0.02));
        for (const EdgeId edge : closed.void_edges) CHECK(off_arc(volume.model, edge, bend) < 0.01);
    }
}

TEST_CASE("smooth void edges between parallel ends are straight")
{
    for (const int sides : {0, 3, 5}) {
        const auto prism = test::prism({.sides = sides, .drop = without(false, false, true)});
        auto volume = prism.open();
        const auto closed = test::seal(volume, {EdgeShape::smooth});
        test::check_sealed(volume);
        for (const EdgeId edge : closed.void_edges) {
            const auto& points = volume.model[edge].points;
            const double chord = (volume.model.at(points.back()) - volume.model.at(points.front())).norm();
            CHECK(edge_length(volume.model, edge) == doctest::Approx(chord).epsilon(1e-12));
        }
    }
}

TEST_CASE("ends that look the same way do not say to which side smooth edges go; one is given by hand")
{
    PrismOptions options = bent(4, 180);
    options.drop = without(false, false, true);
    const auto prism = test::prism(options);
    auto volume = prism.open();
    CHECK(test::refusal([&] { test::seal(volume, {EdgeShape::smooth}); },
                        {"face 1", "face 2", "void_edges"}) == "closure.no_side");
}

TEST_CASE("void edges given by hand are taken as they are")
{
    PrismOptions options = bent(4, 90);
    options.drop = without(false, false, true);
    const auto prism = test::prism(options);
    // The whole prism's corners, by way of its own columns of facet points.
    PrismOptions whole = options;
    whole.drop = nullptr;
    const auto full = test::prism(whole);
    for (const bool backward : {false, true}) {
        for (const bool with_ends : {false, true}) {
            auto volume = prism.open();
            closure::CloseOptions close;
            for (const Edge& edge : full.model.edges) {
                const Vec3 a = full.model.at(edge.points.front()), b = full.model.at(edge.points.back());
                const bool rises = tag_at(volume, a) > 0 && tag_at(volume, b) > 0 &&
                                   (a - b).norm() > 0.4 * kHeight;
                if (!rises) continue;
                closure::VoidEdge given{tag_at(volume, a), tag_at(volume, b), {}};
                for (const Index p : edge.points) given.points.push_back(full.model.at(p));
                if (!with_ends) given.points = {given.points.begin() + 1, given.points.end() - 1};
                if (backward) {
                    std::swap(given.from, given.to);
                    std::reverse(given.points.begin(), given.points.end());
                }
                close.void_edges.push_back(given);
            }
            REQUIRE(close.void_edges.size() == 4);
            matching::MatchOptions match;
            match.vertices = closure::pairs_by_hand(volume, close);
            CHECK(match.vertices.size() == 4);
            const auto closed = test::seal(volume, close, match);
            test::check_sealed(volume);
            CHECK(closed.void_edges.size() == 4);
            CHECK(closure::enclosed_volume(volume) == doctest::Approx(prism.facet_volume).epsilon(0.005));
        }
    }
}

TEST_CASE("void edges given by hand that cannot be ones are refused, and their vertices named")
{
    const auto open = [] {
        return test::prism({.sides = 4, .rows = 2, .drop = without(false, false, false, {0, 1})}).open();
    };
    const auto volume = open();
    const auto tag = [&](double x, double y, double z) { return tag_at(volume, {x, y, z}); };
    const int free_low = tag(0, 1, 0), free_high = tag(0, 1, 2), walled = tag(0, -1, 0), top = tag(0, -1, 2);
    REQUIRE(free_low * free_high * walled * top > 0);
    const auto code = [&](std::vector<closure::VoidEdge> edges, const std::vector<std::string>& words) {
        auto one = open();
        closure::CloseOptions options;
        options.void_edges = std::move(edges);
        return test::refusal([&] { test::seal(one, options); }, words);
    };
    const auto word = [](int number) { return "vertex " + std::to_string(number); };
    CHECK(code({{free_low, free_high, {}}}, {}) == "done");
    CHECK(code({{free_low, free_high, {Vec3(0, 1.2, 1)}}}, {}) == "done");
    CHECK(code({{free_low, 4711, {}}}, {word(free_low), word(4711)}) == "closure.void_edge_vertex");
    CHECK(code({{walled, top, {}}}, {word(walled), "not on a free rim"}) == "closure.void_edge_vertex");
    CHECK(code({{free_low, free_low, {}}}, {word(free_low)}) == "closure.void_edge_ends");
    CHECK(code({{free_low, free_high, {}}, {free_high, free_low, {}}}, {word(free_low), "twice"}) ==
          "closure.void_edge_twice");
    CHECK(code({{free_low, tag(1, 0, 2), {}}}, {word(free_low), word(free_high), "match"}) ==
          "closure.void_edge_contradicts");
    CHECK(code({{free_low, free_high, {Vec3(0, -3, 1)}}}, {word(free_low), "crosses face "}) ==
          "closure.void_edge_crosses");
    CHECK(code({{free_low, free_high, {Vec3(0, 1, std::nan(""))}}}, {"point 1"}) ==
          "closure.void_edge_point");
    CHECK(code({{free_low, free_high, {Vec3(0, 1.1, 1), Vec3(0, 1.1, 1)}}}, {"point 2"}) ==
          "closure.void_edge_point");
    for (const auto& drop : {without(false, true, false), without(true, true, false)}) {
        auto other = test::prism({.drop = drop}).open();
        closure::CloseOptions options;
        options.void_edges = {{1, 5, {}}};
        CHECK(test::refusal([&] { test::seal(other, options); }, {"class"}) == "closure.void_edges_unused");
    }
}

TEST_CASE("an elbow without its outer wall follows its bore")
{
    int combinations = 0;
    for (const int sides : {0, 4}) {
        for (const int hole_sides : {0, 4}) {
            for (const double bend : {60.0, 90.0, 120.0}) {
                for (const auto shape : {EdgeShape::automatic, EdgeShape::follow, EdgeShape::smooth}) {
                    PrismOptions options = bent(sides, bend);
                    options.holes = 1;
                    options.hole_sides = hole_sides;
                    options.drop = [](const Part& p) { return p.role == Role::wall && p.loop == 0; };
                    const auto prism = test::prism(options);
                    auto volume = prism.open();
                    CAPTURE(sides);
                    CAPTURE(hole_sides);
                    CAPTURE(bend);
                    CAPTURE(static_cast<int>(shape));
                    test::seal(volume, {shape});
                    test::check_sealed(volume);
                    CHECK(closure::enclosed_volume(volume) ==
                          doctest::Approx(prism.facet_volume).epsilon(0.03));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " elbows");
}

TEST_CASE("a parallel cap has the shape of the given end")
{
    int combinations = 0;
    for (const int sides : {0, 4, 5}) {
        for (const int holes : {0, 1}) {
            for (const double taper : {1.0, 0.7}) {
                for (const auto end : {End::planar, End::bowed}) {
                    // Bowed outward below, so inward above: what is added there is missing here.
                    const PrismOptions options{.sides = sides,
                                               .holes = holes,
                                               .cuts = 6,
                                               .levels = 4,
                                               .taper = taper,
                                               .source = end,
                                               .lift = 0.3,
                                               .drop = without(false, true, false)};
                    const auto prism = test::prism(options);
                    PrismOptions flat_options = options;
                    flat_options.source = End::planar;
                    const double flat = test::prism(flat_options).facet_volume;
                    const double bulge = prism.facet_volume - flat;
                    closure::CloseOptions close;
                    close.cap = closure::Cap::parallel;
                    auto volume = prism.open();
                    const auto closed = test::seal(volume, close);
                    test::check_sealed(volume);
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(taper);
                    // Only a round rim is as bowed as the one above it: none. Facets of the cap are cut
                    // anew: a bulge is as large within a tenth of itself.
                    const double wanted = flat + bulge - taper * taper * taper * bulge;
                    if (end == End::planar || (sides == 0 && holes == 0))
                        CHECK(std::abs(closure::enclosed_volume(volume) - wanted) <=
                              0.1 * std::abs(bulge) + 1e-9 * flat);
                    CHECK(volume.model[closed.void_faces.front()].geometry == Geometry::parallel);
                    auto level = prism.open();
                    close.cap = closure::Cap::flat;
                    test::seal(level, close);
                    CHECK(closure::enclosed_volume(level) ==
                          doctest::Approx(prism.facet_volume).epsilon(1e-9));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " caps");
}

TEST_CASE("a cap that is not missing, or has nothing to be parallel to, is refused")
{
    closure::CloseOptions parallel;
    parallel.cap = closure::Cap::parallel;
    auto both = test::prism({.drop = without(false, false, true)}).open();
    CHECK(test::refusal([&] { test::seal(both, parallel); }, {"face 1", "face 2", "given"}) ==
          "closure.cap_unused");
    auto neither = test::prism({.drop = without(true, true, false)}).open();
    CHECK(test::refusal([&] { test::seal(neither, parallel); }, {"class V", "flat"}) == "closure.cap_unused");
    auto flat = test::prism({.drop = without(true, true, false)}).open();
    parallel.cap = closure::Cap::flat;
    CHECK(test::refusal([&] { test::seal(flat, parallel); }) == "done");
}

TEST_CASE("a hint names what seals the volume, and nothing else")
{
    const PrismOptions options = {.sides = 4,
                                  .height = 4,
                                  .cuts = 4,
                                  .levels = 24,
                                  .bend = 170,
                                  .drop = without(false, false, false, {1, 2})};
    auto walled = test::prism(options).open();
    CHECK(test::refusal([&] { test::seal(walled, {EdgeShape::straight}); }, {"\"follow\" } seals it"}) ==
          "closure.faces_cross");

    // Plates that stand somehow to each other; what a refusal recommends is done, and has to seal.
    matching::MatchOptions turned;
    turned.flip = {0};
    test::Dice dice(12);
    int refused = 0, recommended = 0;
    for (int trial = 0; trial < (test::whole_families() ? 200 : 40); ++trial) {
        const auto angle = [&] { return dice.between(-2.5, 2.5); };
        const Eigen::AngleAxisd turn(angle(), Vec3(angle(), angle(), angle() + 0.1).normalized());
        const Vec3 shift(angle(), angle(), dice.between(0.3, 2));
        auto prism = test::prism({.sides = 4, .height = 0.1, .drop = without(false, false, true)});
        const Model placed = test::moved(prism.model, [&](const Vec3& p) {
            return p.z() > 0.05 ? Vec3(turn * (p - Vec3(0, 0, 0.1)) + shift) : p;
        });
        const auto open = [&] { return open_volume(placed, prism.roles); };
        CAPTURE(trial);
        for (const auto shape : {EdgeShape::automatic, EdgeShape::straight}) {
            auto volume = open();
            std::string what;
            try {
                test::seal(volume, {shape});
                continue;
            } catch (const NotClosed& error) {
                what = error.what();
            }
            ++refused;
            CAPTURE(what);
            auto again = open();
            if (what.find("edge_shape = \"smooth\"") != std::string::npos) {
                ++recommended;
                CHECK(test::refusal([&] { test::seal(again, {EdgeShape::smooth}); }) == "done");
            } else if (what.find("match{ flip") != std::string::npos) {
                ++recommended;
                CHECK(test::refusal([&] { test::seal(again, {shape}, turned); }) == "done");
            } else {
                CHECK(test::refusal([&] { test::seal(again, {EdgeShape::smooth}); }) != "done");
            }
        }
    }
    CHECK(recommended > 0);
    MESSAGE(refused << " refusals, " << recommended << " with what would seal");
}
