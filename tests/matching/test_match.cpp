// SPDX-License-Identifier: MIT
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/core/error.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using matching::Match;
using matching::MatchOptions;
using test::End;
using test::Part;
using test::PrismOptions;
using test::refusal;
using test::without;

namespace {

/// A plane face with loops of straight sides, and where its corners are.
struct Plate {
    healing::FacetSoup soup;
    std::vector<Vec3> corners;
};

/// @param counts  corners of each loop, the outer one first. @param unlike  how much loops differ from
///         regular ones, 0…1
Plate plate(const std::vector<int>& counts, double unlike, std::mt19937& dice)
{
    std::uniform_real_distribution<double> chance(-1, 1);
    std::vector<Vec2> flat;
    std::vector<std::vector<Index>> loops;
    Plate result;
    for (std::size_t l = 0; l < counts.size(); ++l) {
        // One and two corners: a drop, a lens.
        const int n = counts[l];
        const int cuts = n < 3 ? 12 : 3;
        const double angle = 2 * std::numbers::pi * static_cast<double>(l) /
                                 static_cast<double>(std::max<std::size_t>(counts.size() - 1, 1)) +
                             0.2;
        const Vec2 centre = l == 0 ? Vec2(0, 0)
                                   : Vec2(3.6 * std::cos(angle), (unlike > 0 ? 3.2 : 3.6) * std::sin(angle));
        const double size = l == 0 ? 10 : 1.2;
        std::vector<Vec2> corner;
        for (int i = 0; i < n; ++i) {
            const double turn = 2 * std::numbers::pi * (i + 0.25 * unlike * chance(dice)) / n;
            corner.push_back(centre + size * (1 + 0.15 * unlike * chance(dice)) *
                                          Vec2(std::cos(turn), std::sin(turn)));
        }
        std::vector<Index> loop;
        for (int i = 0; i < n; ++i) {
            const Vec2 a = corner[static_cast<std::size_t>(i)],
                       b = corner[static_cast<std::size_t>((i + 1) % n)];
            for (int k = 0; k < cuts; ++k) {
                const double f = static_cast<double>(k) / cuts;
                Vec2 p = (1 - f) * a + f * b;
                if (n == 2) {
                    const Vec2 across(b.y() - a.y(), a.x() - b.x());
                    p += 0.7 * f * (1 - f) * 2 * across;
                }
                if (n == 1) {
                    // A drop: a round loop that comes to a point at its corner.
                    const double u = std::numbers::pi * (2 * f - 1);
                    const Vec2 out = a - centre, side(-out.y(), out.x());
                    p = centre + out * (k == 0 ? 1 : 0.6 * std::cos(u + std::numbers::pi)) +
                        side * (k == 0 ? 0 : 0.6 * std::sin(u + std::numbers::pi));
                }
                loop.push_back(static_cast<Index>(flat.size()));
                flat.push_back(p);
            }
            result.corners.emplace_back(a.x(), a.y(), 0);
        }
        loops.push_back(loop);
    }
    geometry::TriangulateOptions options;
    options.interior_points = false;
    const auto cells = geometry::triangulate(flat, loops, options);
    for (const Vec2& p : cells.points) result.soup.points.emplace_back(p.x(), p.y(), 0);
    result.soup.triangles = cells.triangles;
    return result;
}

/// A plate and its image, as source and target of class I; the target's facets reordered, and its faces
/// first where asked.
OpenVolume pair_of(const Plate& low, const std::function<Vec3(const Vec3&)>& map, bool target_first,
                   unsigned seed)
{
    healing::FacetSoup soup = low.soup;
    const auto base = static_cast<Index>(soup.points.size());
    for (const Vec3& p : low.soup.points) soup.points.push_back(map(p));
    soup.triangle_label.assign(soup.triangles.size(), target_first ? 1 : 0);
    const std::size_t facets = low.soup.triangles.size();
    std::vector<std::size_t> order(facets);
    for (std::size_t i = 0; i < facets; ++i) order[i] = i;
    std::mt19937 dice(seed);
    std::shuffle(order.begin(), order.end(), dice);
    for (const std::size_t i : order) {
        const Triangle& t = low.soup.triangles[i];
        Triangle moved{t[0] + base, t[2] + base, t[1] + base};
        std::rotate(moved.begin(), moved.begin() + dice() % 3, moved.end());
        soup.triangles.push_back(moved);
        soup.triangle_label.push_back(target_first ? 0 : 1);
    }
    if (target_first) {
        std::rotate(soup.triangles.begin(), soup.triangles.begin() + static_cast<std::ptrdiff_t>(facets),
                    soup.triangles.end());
        std::rotate(soup.triangle_label.begin(),
                    soup.triangle_label.begin() + static_cast<std::ptrdiff_t>(facets),
                    soup.triangle_label.end());
    }
    soup.label_name = target_first ? std::vector<std::string>{"target", "source"}
                                   : std::vector<std::string>{"source", "target"};
    healing::SplitOptions split;
    split.whole_labels = true;
    split.tolerance = 1e-7;
    const Model model = healing::split_facets(soup, split);
    REQUIRE(model.faces.size() == 2);
    const std::size_t source = model.faces[0].name == "source" ? 0 : 1;
    return open_volume(model, {{FaceId(source)}, {FaceId(1 - source)}, {}});
}

/// Every pair is a point and its image.
void check_undone(const OpenVolume& volume, const Match& found, const std::function<Vec3(const Vec3&)>& map)
{
    const Model& model = volume.model;
    // Corners that happen to be blunt are no vertices.
    CHECK(2 * found.vertices.size() == model.vertices.size());
    std::set<VertexId> sources, targets;
    std::size_t wrong = 0;
    for (const auto& [s, t] : found.vertices) {
        sources.insert(s);
        targets.insert(t);
        wrong += (map(model.at(model[s].point)) - model.at(model[t].point)).norm() > 1e-6 * model.diagonal
                     ? 1
                     : 0;
    }
    CHECK(wrong == 0);
    CHECK(sources.size() == found.vertices.size());
    CHECK(targets.size() == found.vertices.size());
    std::set<int> loops;
    CHECK(found.splits.empty());
    for (std::size_t l = 0; l < found.loops.size(); ++l) {
        CHECK(found.loops[l].source == static_cast<int>(l));
        loops.insert(found.loops[l].target);
    }
    CHECK(loops.size() == found.source_loops.size());
}

/// The (source, target) tags of corners that lie over each other along z, turned on by `shift` corners.
std::vector<std::pair<int, int>> tags(const OpenVolume& volume, const Match& found)
{
    std::vector<std::pair<int, int>> result;
    for (const auto& [s, t] : found.vertices) result.emplace_back(volume.model[s].tag, volume.model[t].tag);
    return result;
}

} // namespace

TEST_CASE("pairs undo a rigid motion with scale, for loops of 1 to 8 vertices, whatever the order of faces "
          "and facets")
{
    std::mt19937 dice(11);
    std::uniform_real_distribution<double> chance(-1, 1);
    int combinations = 0;
    for (int corners = 1; corners <= 8; ++corners) {
        for (const double unlike : {0.0, 1.0}) {
            for (int trial = 0; trial < 12; ++trial) {
                const auto low = plate({corners}, unlike, dice);
                // The twist stays below half a step of a regular loop, and the tilt well below a right
                // angle: beyond, other pairs are as good.
                const double twist = 0.9 * chance(dice) * std::numbers::pi / std::max(corners, 2);
                const double tilt = 0.35 * std::numbers::pi * chance(dice);
                const Vec3 axis = Vec3(chance(dice), chance(dice), 0).normalized();
                const Eigen::Matrix3d turn = (Eigen::AngleAxisd(tilt, axis) *
                                              Eigen::AngleAxisd(twist, Vec3::UnitZ()))
                                                 .toRotationMatrix();
                const double scale = trial % 2 == 0 ? 1 : std::exp(chance(dice));
                const Vec3 shift(20 * chance(dice), 20 * chance(dice), 30 + 10 * chance(dice));
                const auto map = [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift); };
                const auto volume = pair_of(low, map, trial % 3 == 0, static_cast<unsigned>(trial));
                CAPTURE(corners);
                CAPTURE(unlike);
                CAPTURE(trial);
                CAPTURE(twist);
                CAPTURE(tilt);
                const Match found = matching::match(volume);
                check_undone(volume, found, map);
                CHECK(found.confidence >= 0);
                CHECK(found.confidence <= 1);
                if (unlike > 0 && corners > 2) CHECK(found.confidence > 0.02);
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " motions of one loop");
}

TEST_CASE("pairs undo a motion for several loops, each going to its own")
{
    std::mt19937 dice(12);
    std::uniform_real_distribution<double> chance(-1, 1);
    int combinations = 0;
    for (const auto& counts : std::vector<std::vector<int>>{
             {4, 4}, {6, 3, 3}, {5, 4, 3, 6}, {4, 1, 1}, {8, 4, 4, 4, 4}, {7, 5, 5, 5, 5, 5}}) {
        for (int trial = 0; trial < 12; ++trial) {
            const auto low = plate(counts, 1, dice);
            // Holes in a ring look alike when turned by one: stay below half of that.
            const double step = std::numbers::pi /
                                static_cast<double>(std::max<std::size_t>(counts.size() - 1, 2));
            const double twist = 0.45 * chance(dice) * std::min(step, std::numbers::pi / counts.front());
            const double tilt = 0.4 * std::numbers::pi * chance(dice);
            const Eigen::Matrix3d turn =
                (Eigen::AngleAxisd(tilt, Vec3(chance(dice), chance(dice), 0).normalized()) *
                 Eigen::AngleAxisd(twist, Vec3::UnitZ()))
                    .toRotationMatrix();
            const double scale = trial % 2 == 0 ? 1 : std::exp(chance(dice));
            const Vec3 shift(20 * chance(dice), 20 * chance(dice), 30);
            const auto map = [&](const Vec3& p) { return Vec3(scale * (turn * p) + shift); };
            const auto volume = pair_of(low, map, trial % 2 == 1, static_cast<unsigned>(trial));
            CAPTURE(counts.size());
            CAPTURE(trial);
            check_undone(volume, matching::match(volume), map);
            ++combinations;
        }
    }
    MESSAGE(combinations << " motions of several loops");
}

TEST_CASE("rotated, tapered, tilted and far loops of prisms are paired along the prism")
{
    int combinations = 0;
    for (const int sides : {3, 4, 6, 8}) {
        for (const int holes : {0, 1, 3}) {
            for (const double taper : {0.1, 1.0, 3.0}) {
                for (const double height : {0.05, 2.0, 100.0}) {
                    for (const double twist : {-0.8, 0.0, 0.8}) {
                        for (const End end : {End::planar, End::tilted}) {
                            if (end == End::tilted && taper < 1) continue; // steep: corners become blunt
                            const PrismOptions options{.sides = sides,
                                                       .height = height,
                                                       .holes = holes,
                                                       .twist = twist * 180 / std::max(sides, 4),
                                                       .taper = taper,
                                                       .target = end,
                                                       .drop = without(false, false, true)};
                            const auto prism = test::prism(options);
                            auto whole = options;
                            whole.drop = nullptr;
                            const auto closed = test::prism(whole);
                            // Where the whole has an edge from a source corner to a target corner, there
                            // the pair belongs.
                            std::set<std::pair<std::array<long, 3>, std::array<long, 3>>> sides_of_whole;
                            const auto key = [](const Vec3& p) {
                                return std::array<long, 3>{std::lround(p.x() * 1e6), std::lround(p.y() * 1e6),
                                                           std::lround(p.z() * 1e6)};
                            };
                            for (const Edge& edge : closed.model.edges) {
                                const Vec3 a = closed.model.at(edge.points.front()),
                                           b = closed.model.at(edge.points.back());
                                sides_of_whole.emplace(key(a), key(b));
                                sides_of_whole.emplace(key(b), key(a));
                            }
                            const auto volume = prism.open();
                            CAPTURE(sides);
                            CAPTURE(holes);
                            CAPTURE(taper);
                            CAPTURE(height);
                            CAPTURE(twist);
                            CAPTURE(static_cast<int>(end));
                            const Match found = matching::match(volume);
                            CHECK(found.vertices.size() == static_cast<std::size_t>(sides + 4 * holes));
                            std::size_t wrong = 0;
                            for (const auto& [s, t] : found.vertices) {
                                const Vec3 a = volume.model.at(volume.model[s].point),
                                           b = volume.model.at(volume.model[t].point);
                                wrong += sides_of_whole.contains({key(a), key(b)}) ? 0 : 1;
                            }
                            CHECK(wrong == 0);
                            ++combinations;
                        }
                    }
                }
            }
        }
    }
    MESSAGE(combinations << " prisms");
}

TEST_CASE("what the walls join is paired, however far the prism is twisted, and is sure")
{
    int combinations = 0;
    for (const int sides : {3, 4, 6}) {
        for (const int holes : {0, 2}) {
            for (const double twist : {0.0, 100.0, 200.0}) {
                for (const auto& gone : std::vector<std::vector<int>>{{0}, {0, 1}}) {
                    const auto prism = test::prism({.sides = sides,
                                                    .height = 8,
                                                    .holes = holes,
                                                    .levels = 24,
                                                    .twist = twist,
                                                    .drop = without(false, false, false, gone)});
                    const auto volume = prism.open();
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(twist);
                    CAPTURE(gone.size());
                    const Match found = matching::match(volume);
                    REQUIRE(found.hard.size() == found.vertices.size());
                    CHECK(found.confidence == 1);
                    const Eigen::AngleAxisd turn(twist * std::numbers::pi / 180, Vec3::UnitZ());
                    std::size_t wrong = 0, hard = 0;
                    for (std::size_t i = 0; i < found.vertices.size(); ++i) {
                        const auto& [s, t] = found.vertices[i];
                        const Vec3 image = turn * volume.model.at(volume.model[s].point) + Vec3(0, 0, 8);
                        wrong += (image - volume.model.at(volume.model[t].point)).norm() > 1e-6 ? 1 : 0;
                        hard += found.hard[i] ? 1 : 0;
                    }
                    CHECK(wrong == 0);
                    CHECK(hard == found.vertices.size() - (gone.size() - 1));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " twisted prisms with walls");
}

TEST_CASE("forced vertices, loops and directions are obeyed")
{
    const auto prism = test::prism(
        {.sides = 4, .holes = 3, .hole_sides = 4, .drop = without(false, false, true)});
    const auto volume = prism.open();
    const Match free = matching::match(volume);
    const auto pairs = tags(volume, free);
    // Each corner of the outer loop sent one or two on, or one back.
    for (std::size_t shift = 0; shift < 4; ++shift) {
        MatchOptions options;
        options.vertices = {{pairs[0].first, pairs[shift].second}};
        const Match forced = matching::match(volume, options);
        CHECK(tags(volume, forced)[0] == options.vertices[0]);
        for (std::size_t i = 0; i < 4; ++i)
            CHECK(tags(volume, forced)[i] == std::pair(pairs[i].first, pairs[(i + shift) % 4].second));
    }
    std::vector<int> order{0, 1, 2, 3};
    int combinations = 0;
    do {
        MatchOptions options;
        for (int s = 0; s < 4; ++s) options.loops.emplace_back(s, order[static_cast<std::size_t>(s)]);
        const Match forced = matching::match(volume, options);
        for (std::size_t s = 0; s < 4; ++s) CHECK(forced.loops[s].target == order[s]);
        CHECK(forced.vertices.size() == free.vertices.size());
        ++combinations;
    } while (std::next_permutation(order.begin(), order.end()));
    MESSAGE(combinations << " permutations of loops");
    for (int s = 0; s < 4; ++s) {
        MatchOptions options;
        options.flip = {s};
        const Match flipped = matching::match(volume, options);
        for (std::size_t l = 0; l < 4; ++l)
            CHECK((flipped.loops[l].flipped != free.loops[l].flipped) == (static_cast<int>(l) == s));
    }
}

TEST_CASE("forced parts that contradict the faces or each other are refused by name")
{
    const auto walls =
        test::prism({.sides = 4, .holes = 1, .drop = without(false, false, false, {0, 1})}).open();
    const Match found = matching::match(walls);
    const auto pairs = tags(walls, found);
    std::size_t hard = 0;
    while (!found.hard[hard]) ++hard;
    MatchOptions vertices;
    vertices.vertices = {{pairs[hard].first, pairs[(hard + 1) % 4].second}};
    CHECK(refusal([&] { matching::match(walls, vertices); }, {"vertex " + std::to_string(pairs[hard].first),
                                                              "walls"}) == "matching.vertices_contradict");
    MatchOptions loops;
    loops.loops = {{0, 1}};
    CHECK(refusal([&] { matching::match(walls, loops); }, {"source loop 1", "target loop 2"}) ==
          "matching.loops_contradict");
    for (const auto& pair : std::vector<std::pair<int, int>>{{0, 2}, {2, 0}, {-1, 0}, {0, -1}, {5, 5}}) {
        MatchOptions options;
        options.loops = {pair};
        CHECK(refusal([&] { matching::match(walls, options); }, {"from 1 to 2"}) == "matching.unknown_loop");
    }
    MatchOptions unknown;
    unknown.vertices = {{9999, pairs[0].second}};
    CHECK(refusal([&] { matching::match(walls, unknown); }, {"9999", "source"}) == "matching.unknown_vertex");
    unknown.vertices = {{pairs[0].first, 9999}};
    CHECK(refusal([&] { matching::match(walls, unknown); }, {"9999", "target"}) == "matching.unknown_vertex");
    const auto open = test::prism({.sides = 4, .holes = 1, .drop = without(false, false, true)}).open();
    MatchOptions both;
    both.loops = {{0, 0}, {1, 0}};
    CHECK(refusal([&] { matching::match(open, both); }, {"loop"}) != "done");
    for (const int s : {-1, 2, 7}) {
        MatchOptions flip;
        flip.flip = {s};
        CHECK(refusal([&] { matching::match(open, flip); }, {"loop"}) == "matching.unknown_loop");
    }
    // Two vertex pairs of one loop that no turn of it keeps.
    const auto tagged = tags(open, matching::match(open));
    MatchOptions crossed;
    crossed.vertices = {{tagged[0].first, tagged[0].second}, {tagged[1].first, tagged[2].second}};
    CHECK(refusal([&] { matching::match(open, crossed); }, {}) != "done");
}

TEST_CASE("a target that could be turned either way has little confidence, one that could not has much")
{
    // A square turned by 45° fits as well one corner on as one back.
    const auto even = test::prism({.sides = 4, .twist = 45, .drop = without(false, false, true)}).open();
    const Match unsure = matching::match(even);
    CHECK(unsure.confidence < 0.05);
    CHECK(!unsure.notes.empty()); // the two candidates are named
    const auto plain = test::prism({.sides = 4, .drop = without(false, false, true)}).open();
    CHECK(matching::match(plain).confidence > 0.9);
    const auto turned = test::prism({.sides = 4, .twist = 30, .drop = without(false, false, true)}).open();
    const double between = matching::match(turned).confidence;
    CHECK(between > unsure.confidence);
    CHECK(between < 0.9);
    // Two holes that have both gone to the middle between their places.
    std::mt19937 dice(1);
    const auto two = plate({12, 4, 4}, 0, dice);
    const auto quarter = [](const Vec3& p) { return Vec3(-p.y(), p.x(), 4); };
    const Match holes = matching::match(pair_of(two, quarter, false, 0));
    CHECK(holes.confidence < 0.1);
    CHECK(!holes.notes.empty());
    // Walls all round: nothing is guessed.
    CHECK(matching::match(test::prism({.sides = 4, .levels = 8, .twist = 45}).open()).confidence == 1);
}

TEST_CASE("a smooth loop goes where it is turned least, wherever its vertex happens to be, and is cut there")
{
    int combinations = 0;
    for (const int holes : {0, 1, 3}) {
        for (const double twist : {0.0, 25.0}) {
            for (unsigned seed = 0; seed < 5; ++seed) {
                const auto prism = test::prism({.sides = 0,
                                                .holes = holes,
                                                .hole_sides = 0,
                                                .cuts = 3,
                                                .twist = twist,
                                                .drop = without(false, false, true)});
                healing::FacetSoup soup = prism.soup;
                std::vector<std::size_t> order(soup.points.size());
                for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
                std::mt19937 dice(seed);
                std::shuffle(order.begin(), order.end(), dice);
                for (std::size_t i = 0; i < order.size(); ++i) soup.points[order[i]] = prism.soup.points[i];
                for (Triangle& t : soup.triangles) {
                    for (Index& p : t) p = static_cast<Index>(order[static_cast<std::size_t>(p)]);
                }
                healing::SplitOptions split;
                split.whole_labels = true;
                const auto volume = open_volume(healing::split_facets(soup, split),
                                                {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
                const Match found = matching::match(volume);
                CAPTURE(holes);
                CAPTURE(twist);
                CAPTURE(seed);
                CHECK(found.vertices.size() + found.splits.size() == static_cast<std::size_t>(holes) + 1);
                // With holes to tell the twist it is undone, by itself a circle is not turned at all; to
                // half a facet and a lay's slack.
                const double turn = holes > 1 ? twist * std::numbers::pi / 180 : 0;
                for (const matching::Split& cut : found.splits) {
                    CHECK(cut.on_target);
                    const Vec3 from = volume.model.at(volume.model[cut.vertex].point);
                    std::vector<Vec3> run;
                    for (const Index p : volume.model[cut.edge].points) run.push_back(volume.model.at(p));
                    const auto arc = geometry::arc_lengths(run);
                    const Vec3 to = geometry::point_at(run, arc, cut.fraction * arc.back());
                    const Vec3 image = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * from + Vec3(0, 0, 2);
                    if (holes != 1) CHECK((image - to).norm() < 0.2);
                }
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " sets of circles");
}

TEST_CASE("loops with different numbers of corners are paired by length, every corner with a partner or a "
          "place for one")
{
    int combinations = 0;
    for (const int low : {0, 3, 4, 5, 8}) {
        for (const int high : {0, 3, 4, 6}) {
            if (low == high) continue;
            auto soup = test::prism({.sides = low, .drop = without(false, true, true)}).soup;
            const auto upper = test::prism({.sides = high, .drop = without(true, false, true)}).soup;
            const auto base = static_cast<Index>(soup.points.size());
            soup.points.insert(soup.points.end(), upper.points.begin(), upper.points.end());
            for (const Triangle& t : upper.triangles) {
                soup.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
                soup.triangle_label.push_back(1);
            }
            soup.label_name.push_back("top");
            healing::SplitOptions split;
            split.whole_labels = true;
            const auto volume = open_volume(healing::split_facets(soup, split),
                                            {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
            const Match found = matching::match(volume);
            CAPTURE(low);
            CAPTURE(high);
            std::set<VertexId> met;
            for (const auto& [s, t] : found.vertices) {
                CHECK(met.insert(s).second);
                CHECK(met.insert(t).second);
            }
            for (const matching::Split& cut : found.splits) CHECK(met.insert(cut.vertex).second);
            const auto corners = static_cast<std::size_t>((low == 0 ? 1 : low) + (high == 0 ? 0 : high));
            CHECK(met.size() >= corners);
            CHECK(!found.notes.empty());
            ++combinations;
        }
    }
    MESSAGE(combinations << " pairs of ends");
}

TEST_CASE("loops that differ in number are refused, and both numbers named")
{
    for (const int low : {0, 1, 3}) {
        for (const int high : {0, 1, 3}) {
            if (low == high) continue;
            auto soup = test::prism({.sides = 5, .holes = low, .drop = without(false, true, true)}).soup;
            const auto upper =
                test::prism({.sides = 5, .holes = high, .drop = without(true, false, true)}).soup;
            const auto base = static_cast<Index>(soup.points.size());
            soup.points.insert(soup.points.end(), upper.points.begin(), upper.points.end());
            for (const Triangle& t : upper.triangles) {
                soup.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
                soup.triangle_label.push_back(1);
            }
            soup.label_name.push_back("top");
            healing::SplitOptions split;
            split.whole_labels = true;
            const auto volume = open_volume(healing::split_facets(soup, split),
                                            {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
            CHECK(refusal([&] { matching::match(volume); },
                          {std::to_string(low + 1) + (low == 0 ? " loop, " : " loops, "),
                           ") has " + std::to_string(high + 1) + ": both"}) == "matching.loop_counts");
        }
    }
    const auto no_target = test::prism({.drop = without(false, true, false)}).open();
    CHECK(refusal([&] { matching::match(no_target); }, {"target"}) == "matching.no_rim");
}
