// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/volumes.h"
#include "two_ends.h"

#include <lacuna/closure/close.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/matching/match.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/shared/split_edge.h>

#include <map>
#include <numeric>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using matching::Match;
using matching::MatchOptions;
using test::circle;
using test::Ends;
using test::even;
using test::lifted;
using test::Outline;
using test::polygon;
using test::refusal;
using test::regular;
using test::two_ends;

namespace {

/// What a round void edge may be twisted by (match.h).
const double kMostTwist = 2 * std::asin(0.1); // a round wall that is ruled with it is narrower by 1 % halfway

Vec3 at(const OpenVolume& volume, VertexId v) { return volume.model.at(volume.model[v].point); }

/// Angle from the source vertex of a pair round to its target vertex, about z, in (-π, π].
double twist(const OpenVolume& volume, const std::pair<VertexId, VertexId>& pair)
{
    const Vec3 a = at(volume, pair.first), b = at(volume, pair.second);
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.x() * b.x() + a.y() * b.y());
}

/// Pairs are one-to-one and keep the order along the loops; loops are walks.
void check_pairs(const OpenVolume& volume, const Match& found)
{
    CHECK(found.splits.empty());
    CHECK(found.hard.size() == found.vertices.size());
    CHECK(found.confidence >= 0);
    CHECK(found.confidence <= 1);
    std::set<VertexId> met;
    std::map<VertexId, VertexId> partner;
    for (const auto& [s, t] : found.vertices) {
        CHECK(met.insert(s).second);
        CHECK(met.insert(t).second);
        partner[s] = t;
    }
    std::vector<VertexId> listed, walked;
    for (const auto& pair : found.vertices) listed.push_back(pair.first);
    for (std::size_t l = 0; l < found.loops.size(); ++l) {
        const auto& low = found.source_loops[l].uses;
        const auto& high = found.target_loops[static_cast<std::size_t>(found.loops[l].target)].uses;
        for (const auto* uses : {&low, &high}) {
            for (std::size_t i = 0; i < uses->size(); ++i)
                CHECK(use_to(volume.model, (*uses)[i]) ==
                      use_from(volume.model, (*uses)[(i + 1) % uses->size()]));
        }
        std::vector<std::size_t> places;
        for (const EdgeUse& use : low) {
            const auto pair = partner.find(use_from(volume.model, use));
            if (pair == partner.end()) continue;
            walked.push_back(pair->first);
            std::size_t j = 0;
            while (j < high.size() && use_from(volume.model, high[j]) != pair->second) ++j;
            REQUIRE(j < high.size());
            places.push_back(j);
        }
        CHECK(!places.empty());
        if (!found.loops[l].flipped) std::reverse(places.begin(), places.end());
        std::size_t falls = 0;
        for (std::size_t k = 0; k < places.size(); ++k)
            falls += places[(k + 1) % places.size()] <= places[k] ? 1 : 0;
        CHECK(falls == 1);
    }
    CHECK((listed == walked)); // source loop by source loop in walking order
}

/// Match, split, close, sweep: sealed, of the right volume, and a valid mesh. @return the match, its splits
/// made.
Match check_swept(OpenVolume volume, double facet_volume, double closeness, const MatchOptions& options = {},
                  bool sweeps = true)
{
    const Match found = matching::match(volume, options);
    const auto [whole, applied] = matching::apply_splits(volume, found);
    check_pairs(whole, applied);
    CHECK(applied.vertices.size() == found.vertices.size() + found.splits.size());

    closure::Closed closed = closure::close(volume, found);
    CHECK(closed.closure.watertight);
    volume = std::move(closed.volume);
    CHECK(closure::is_watertight(volume));
    CHECK(closure::enclosed_volume(volume) == doctest::Approx(facet_volume).epsilon(closeness));
    sweep::SweepOptions sweep;
    sweep.layers.count = 3;
    const double size = volume.model.diagonal / 16;
    if (found.loops.size() > 1) sweep.size = [size](const Vec3&) { return size; };
    if (sweeps) test::check_valid(sweep::sweep(volume, sweep).mesh);
    return applied;
}

double area(const Outline& outline)
{
    double sum = 0;
    for (std::size_t i = 0; i < outline.points.size(); ++i) {
        const Vec2 &a = outline.points[i], &b = outline.points[(i + 1) % outline.points.size()];
        sum += (a.x() * b.y() - a.y() * b.x()) / 2;
    }
    return sum;
}

/// Volume between two parallel ends of like shape.
double frustum(const Outline& low, const Outline& high, double scale, double height)
{
    const double a = area(low), b = area(high) * scale * scale;
    return height / 3 * (a + b + std::sqrt(a * b));
}

/// Source vertices and target vertices that a loop's pairs leave alone.
std::set<VertexId> alone(const OpenVolume& volume, const Match& found)
{
    std::set<VertexId> result;
    for (const auto* loops : {&found.source_loops, &found.target_loops}) {
        for (const Rim& rim : *loops) {
            for (const EdgeUse& use : rim.uses) result.insert(use_from(volume.model, use));
        }
    }
    for (const auto& [s, t] : found.vertices) {
        result.erase(s);
        result.erase(t);
    }
    return result;
}

} // namespace

TEST_CASE("round ends with any numbers of vertices anywhere close to the volume between them, and sweep")
{
    std::mt19937 dice(31);
    std::uniform_real_distribution<double> chance(0, 1);
    int combinations = 0;
    for (const auto& [low, high] : std::vector<std::pair<int, int>>{
             {1, 1}, {1, 2}, {2, 1}, {2, 2}, {9, 8}, {8, 9}, {9, 9}, {72, 45}, {45, 72}}) {
        for (const double scale : {1.0, 0.5}) {
            for (int trial = 0; trial < 3; ++trial) {
                const Ends bottom{circle(even(low, chance(dice)), 1, 72)};
                const Ends top{circle(even(high, chance(dice)), 1, 72)};
                const auto volume = two_ends(bottom, top, lifted(1.5, scale));
                CAPTURE(low);
                CAPTURE(high);
                CAPTURE(scale);
                CAPTURE(trial);
                const Match found = matching::match(volume);
                const auto [whole, applied] = matching::apply_splits(volume, found);
                for (const auto& pair : applied.vertices)
                    CHECK(std::abs(twist(whole, pair)) <= kMostTwist + 1e-3);
                CHECK(found.splits.size() <=
                      1); // smooth vertices need no partners, but a loop hangs on one pair
                check_swept(volume, frustum(bottom[0], top[0], scale, 1.5), 0.015);
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " pairs of circles");
}

TEST_CASE("two closed circles are joined straight up, wherever their seams are")
{
    double least = 1;
    for (int seam = 0; seam < 36; ++seam) {
        const Outline bottom = circle({0.1}, 1, 90), top = circle({seam / 36.0}, 1, 90);
        auto volume = two_ends({bottom}, {top}, lifted(2));
        CAPTURE(seam);
        Match found = matching::match(volume);
        CHECK(found.confidence > 0.5);
        const auto [whole, applied] = matching::apply_splits(volume, found);
        REQUIRE(applied.vertices.size() == 1);
        const double seams = std::abs(
            std::remainder(2 * std::numbers::pi * (seam / 36.0 - 0.1), 2 * std::numbers::pi));
        const double turned = std::abs(twist(whole, applied.vertices.front()));
        // Near seams are joined as they are; others straight up, to where a facet's chord is cut.
        if (seams <= kMostTwist - 1e-2) CHECK(turned == doctest::Approx(seams).epsilon(1e-2));
        if (seams >= kMostTwist + 1e-2) CHECK(turned < 1e-3);
        CHECK(found.splits.size() == (seams > kMostTwist ? 1 : 0));
        volume = closure::close(volume, found).volume;
        least = std::min(least, closure::enclosed_volume(volume) / (2 * area(bottom)));
    }
    CHECK(least > 0.99);
    MESSAGE("least share of the volume: " << least);
}

TEST_CASE("a round loop that narrows round a bore that does not is joined straight up")
{
    for (const double narrowed : {0.4, 0.5, 0.8, 1.3}) {
        CAPTURE(narrowed);
        const test::Prism ring = test::prism(
            {.sides = 0,
             .radius = 3,
             .height = 3,
             .hole_list = {{Vec2(0, 0), 1.0}},
             .cuts = 6,
             .levels = 4,
             .drop = [](const test::Part& part) { return part.role == Role::wall && part.loop == 0; }});
        const Model model = test::moved(ring.model, [&](const Vec3& p) {
            const double r = std::hypot(p.x(), p.y()), grown = 1 + (r - 1) * (1 + (narrowed - 1) * p.z() / 3);
            return Vec3(p.x() * grown / r, p.y() * grown / r, p.z());
        });
        const OpenVolume open = open_volume(model, ring.roles);
        const auto [volume, found] = matching::apply_splits(open, matching::match(open));
        REQUIRE(!found.vertices.empty());
        for (const auto& pair : found.vertices) CHECK(std::abs(twist(volume, pair)) <= kMostTwist + 1e-3);
        const double high = 1 + 2 * narrowed,
                     whole = std::numbers::pi * (9 + 3 * high + high * high) - 3 * std::numbers::pi;
        CHECK(closure::enclosed_volume(closure::close(volume, found).volume) ==
              doctest::Approx(whole).epsilon(0.015));
    }
}

TEST_CASE("every corner meets a corner or a vertex made for it, on both ends, and it sweeps")
{
    std::mt19937 dice(32);
    std::uniform_real_distribution<double> chance(-1, 1);
    int combinations = 0;
    for (const auto& [low, high] :
         std::vector<std::pair<int, int>>{{9, 8}, {8, 9}, {3, 4}, {4, 3}, {5, 12}, {4, 1}, {1, 4}, {6, 2}}) {
        for (const double scale : {1.0, 0.6}) {
            const auto outline = [&](int n, double turn) {
                return n < 3 ? circle(even(n, turn)) : polygon(regular(n, 1, turn), 3);
            };
            const Ends bottom{outline(low, 0)}, top{outline(high, 0.2 * chance(dice))};
            const auto volume = two_ends(bottom, top, lifted(1.5, scale));
            CAPTURE(low);
            CAPTURE(high);
            CAPTURE(scale);
            const Match found = matching::match(volume);
            const auto [whole, applied] = matching::apply_splits(volume, found);
            check_pairs(whole, applied);
            const auto left = alone(whole, applied);
            for (const VertexId v : left) CHECK(!(at(whole, v).z() < 0.1 ? low >= 3 : high >= 3));
            const int corners = std::max(low < 3 ? 0 : low, high < 3 ? 0 : high);
            CHECK(applied.vertices.size() >= static_cast<std::size_t>(corners));
            CHECK(applied.vertices.size() <= static_cast<std::size_t>(low + high));
            // No corner is left to a split while one of the other end is as near.
            if (low >= 3 && high >= 3) {
                const double fewer = std::min(low, high);
                CHECK(static_cast<double>(found.vertices.size()) >= fewer - 0.5);
            }
            // Quads at a source corner that is to lie on a straight side of the target have a straight angle
            // there: not by this way.
            const bool sweeps = high < 3 || high >= low || low >= 5;
            check_swept(volume, frustum(bottom[0], top[0], scale, 1.5), 0.12, {}, sweeps);
            ++combinations;
        }
    }
    MESSAGE(combinations << " pairs of polygons");
}

TEST_CASE("a vertex on the middle of a side does not draw a corner to it, and needs no partner")
{
    const std::vector<Vec2> box{{0, 0}, {3, 0}, {3, 2}, {0, 2}};
    int combinations = 0;
    for (std::size_t low = 0; low <= 4; ++low) {
        for (std::size_t high = 0; high <= 4; ++high) {
            // Side 4: no extra vertex.
            const auto outline = [&](std::size_t side) {
                return side == 4 ? polygon(box) : polygon(box, 4, {{side, 0.5}});
            };
            const auto volume = two_ends({outline(low)}, {outline(high)}, lifted(1));
            CAPTURE(low);
            CAPTURE(high);
            const Match found = check_swept(volume, 6, 1e-9);
            std::size_t straight = 0;
            for (const auto& [s, t] : found.vertices)
                straight += (at(volume, s) + Vec3(0, 0, 1) - at(volume, t)).norm() < 1e-6 ? 1 : 0;
            CHECK(straight == found.vertices.size());
            CHECK(found.vertices.size() == (low == high && low < 4 ? 5 : 4));
            ++combinations;
        }
    }
    MESSAGE(combinations << " boxes");
}

TEST_CASE("a void edge of a corner left over ends at its share of the way between its neighbours")
{
    // A box and a box with one corner cut off: two corners there, one is left over.
    for (const double cut : {0.2, 0.5, 0.9}) {
        const std::vector<Vec2> box{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
        const std::vector<Vec2> notched{{0, 0}, {4, 0}, {4, 3 - cut}, {4 - cut, 3}, {0, 3}};
        for (const bool turned : {false, true}) {
            const Ends one{polygon(box, 3)}, other{polygon(notched, 3)};
            const auto volume = turned ? two_ends(other, one, lifted(2)) : two_ends(one, other, lifted(2));
            CAPTURE(cut);
            CAPTURE(turned);
            const Match found = check_swept(volume, 24 - cut * cut / 2, 0.03, {}, !turned);
            CHECK(found.vertices.size() == 5);
            Match raw = matching::match(volume);
            REQUIRE(raw.splits.size() == 1);
            CHECK(raw.splits.front().on_target == turned);
            // On one of the two sides beside the box's corner.
            std::vector<Vec3> run;
            for (const Index p : volume.model[raw.splits.front().edge].points)
                run.push_back(volume.model.at(p));
            const auto arc = geometry::arc_lengths(run);
            const Vec3 place = geometry::point_at(run, arc, raw.splits.front().fraction * arc.back());
            CHECK((place.head<2>() - Vec2(4, 3)).norm() < 3);
            CHECK((std::abs(place.x() - 4) < 1e-9 || std::abs(place.y() - 3) < 1e-9));
        }
    }
}

TEST_CASE("loops with as many smooth vertices go vertex to vertex when their lengths differ, and straight up "
          "when they are turned")
{
    // Rounded boxes: every vertex lies where a side goes over into an arc.
    const auto rounded = [](double radius) {
        Outline outline;
        const std::vector<Vec2> centres{{4 - radius, 3 - radius},
                                        {radius - 4, 3 - radius},
                                        {radius - 4, radius - 3},
                                        {4 - radius, radius - 3}};
        for (int corner = 0; corner < 4; ++corner) {
            for (int k = 0; k <= 8; ++k) {
                const double angle = std::numbers::pi / 2 * (corner + k / 8.0);
                if (k == 0 || k == 8) outline.vertices.push_back(outline.points.size());
                outline.points.emplace_back(centres[static_cast<std::size_t>(corner)] +
                                            radius * Vec2(std::cos(angle), std::sin(angle)));
            }
        }
        return outline;
    };
    for (const double radius : {0.4, 1.0, 2.0, 2.8}) {
        const Outline low = rounded(1), high = rounded(radius);
        const auto volume = two_ends({low}, {high}, lifted(2));
        CAPTURE(radius);
        const Match found = check_swept(volume, (area(low) + area(high)), 0.03);
        REQUIRE(found.vertices.size() == 8);
        for (const auto& [s, t] : found.vertices) CHECK(volume.model[t].tag == volume.model[s].tag + 8);
    }
    for (const int n : {2, 3, 5}) {
        for (const double phase : {0.0, 0.02, 0.2, 0.5}) {
            const auto volume = two_ends({circle(even(n))}, {circle(even(n, phase))}, lifted(2));
            Match found = matching::match(volume);
            CAPTURE(n);
            CAPTURE(phase);
            const bool turned = phase / n > 1.0 / 32;
            CHECK(found.vertices.size() == (turned ? 0 : static_cast<std::size_t>(n)));
            CHECK(found.splits.size() == (turned ? 1 : 0));
        }
    }
}

TEST_CASE("free edges divided anyhow beside given walls close to the same volume, and no wall is split")
{
    std::mt19937 dice(33);
    std::uniform_real_distribution<double> chance(0.1, 0.9);
    int combinations = 0;
    for (const int sides : {4, 6}) {
        for (const int holes : {0, 1}) {
            for (const auto& gone : std::vector<std::vector<int>>{{0}, {0, 1}, {0, 1, 2}, {0, 2}}) {
                for (int trial = 0; trial < 4; ++trial) {
                    const auto prism = test::prism(
                        {.sides = sides, .holes = holes, .drop = test::without(false, false, false, gone)});
                    OpenVolume volume = prism.open();
                    for (int k = 0; k <= trial; ++k) {
                        const auto free = free_edges(volume);
                        std::vector<EdgeId> rim;
                        for (const EdgeId e : free) {
                            const Edge& edge = volume.model[e];
                            const double rise = volume.model.at(edge.points.back()).z() -
                                                volume.model.at(edge.points.front()).z();
                            if (std::abs(rise) < 1e-9) rim.push_back(e);
                        }
                        REQUIRE(!rim.empty());
                        split_edge(volume.model, rim[dice() % rim.size()], chance(dice));
                    }
                    CAPTURE(sides);
                    CAPTURE(holes);
                    CAPTURE(gone.size());
                    CAPTURE(trial);
                    const Match found = check_swept(volume, prism.facet_volume, 1e-9);
                    CHECK(found.vertices.size() >= static_cast<std::size_t>(sides));
                    ++combinations;
                }
            }
        }
    }
    MESSAGE(combinations << " volumes");
}

TEST_CASE("several loops, each with its own numbers of vertices, are matched, split and swept")
{
    for (const double turn : {0.0, 0.2}) {
        const Ends bottom{polygon(regular(4, 6), 6), circle({0.3}, 1, 24, {2, 0.5}),
                          circle(even(4), 1.2, 24, {-2, 0.5}), polygon(regular(3, 0.7), 4)};
        Ends top{polygon(regular(4, 6), 6), circle({0.8}, 1, 24, {2, 0.5}),
                 circle(even(3, 0.4), 1.2, 24, {-2, 0.5}), polygon(regular(3, 0.7), 4)};
        top[3].vertices.push_back(top[3].points.size() - 2);
        const auto volume = two_ends(bottom, top, lifted(3, 1, turn));
        CAPTURE(turn);
        double section = area(bottom[0]);
        for (std::size_t l = 1; l < 4; ++l) section -= area(bottom[l]);
        const Match found = check_swept(volume, 3 * section, 0.02);
        REQUIRE(found.loops.size() == 4);
        // Each loop to its own: the longest first, so like for like.
        const Eigen::AngleAxisd about(turn, Vec3::UnitZ());
        for (const auto& [s, t] : matching::match(volume).vertices) {
            const Vec3 image = about * at(volume, s) + Vec3(0, 0, 3);
            CHECK((image - at(volume, t)).norm() < 0.5);
        }
    }
}

TEST_CASE("a mesh that the target came with is split at its nodes")
{
    // The circle's facets as quads of a ring about a square would do; here one row of quads round a hole.
    healing::FacetSoup soup;
    const int n = 24;
    for (const double z : {0.0, 1.0}) {
        const auto base = static_cast<Index>(soup.points.size());
        for (const double radius : {1.0, 0.5}) {
            for (int i = 0; i < n; ++i) {
                const double angle = 2 * std::numbers::pi * (i + (z > 0 ? 7 : 0)) / n;
                soup.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
            }
        }
        for (Index i = 0; i < n; ++i) {
            const Index j = (i + 1) % n;
            soup.quads.push_back({base + i, base + j, base + n + j, base + n + i});
            soup.quad_label.push_back(z > 0 ? 1 : 0);
            if (z == 0) std::swap(soup.quads.back()[1], soup.quads.back()[3]);
        }
    }
    healing::SplitOptions options;
    options.whole_labels = true;
    const auto open = open_volume(healing::split_facets(soup, options),
                                  {{FaceId(std::size_t(0))}, {FaceId(std::size_t(1))}, {}});
    const auto [volume, found] = matching::apply_splits(open, matching::match(open));
    check_pairs(volume, found);
    CHECK(volume.model.faces[1].given_quads == open.model.faces[1].given_quads);
    CHECK((volume.model.points == open.model.points));
    for (const auto& pair : found.vertices) CHECK(std::abs(twist(volume, pair)) <= kMostTwist + 1e-9);
}

TEST_CASE("vertices given by hand are obeyed on loops paired by length, and crossing ones refused by tag")
{
    const auto volume = two_ends({polygon(regular(5), 3)}, {polygon(regular(4), 3)}, lifted(1));
    // Tags 1…5 below, 6…9 above.
    for (int t = 6; t <= 9; ++t) {
        MatchOptions options;
        options.vertices = {{1, t}};
        const Match found = matching::match(volume, options);
        bool obeyed = false;
        for (std::size_t i = 0; i < found.vertices.size(); ++i) {
            const auto& [a, b] = found.vertices[i];
            if (volume.model[a].tag != 1) continue;
            obeyed = volume.model[b].tag == t;
            CHECK(found.hard[i]);
        }
        CHECK(obeyed);
        const auto [whole, applied] = matching::apply_splits(volume, found);
        check_pairs(whole, applied);
        CHECK(applied.vertices.size() == 5);
    }
    MatchOptions two;
    two.vertices = {{1, 6}, {3, 8}};
    check_swept(volume, (area(polygon(regular(5))) + area(polygon(regular(4)))) / 2, 0.1, two, false);
    MatchOptions crossed;
    crossed.vertices = {{1, 6}, {2, 8}, {3, 7}};
    CHECK(refusal([&] { matching::match(volume, crossed); },
                  {"source loop 1", "vertex 1", "vertex 2", "vertex 3", "vertex 6", "vertex 7",
                   "vertex 8"}) == "matching.vertices_contradict");
    MatchOptions shared;
    shared.vertices = {{1, 6}, {2, 6}};
    CHECK(refusal([&] { matching::match(volume, shared); }, {"1", "2", "6"}) ==
          "matching.vertices_contradict");
    const Match free = matching::match(volume);
    MatchOptions flip;
    flip.flip = {0};
    const Match flipped = matching::match(volume, flip);
    CHECK(flipped.loops[0].flipped != free.loops[0].flipped);
    const auto [whole, applied] = matching::apply_splits(volume, flipped);
    check_pairs(whole, applied);
}

TEST_CASE("splits are made once, and closing with or without them made is the same")
{
    auto volume = two_ends({polygon(regular(9), 2)}, {polygon(regular(8), 2)}, lifted(1));
    const Match found = matching::match(volume);
    CHECK(!found.splits.empty());
    const auto by_close = closure::close(volume, found).volume;
    const auto applied = matching::apply_splits(volume, found);
    const std::size_t edges = applied.volume.model.edges.size();
    CHECK(edges == volume.model.edges.size() + found.splits.size());
    const auto again = matching::apply_splits(applied.volume, applied.match);
    CHECK(again.volume.model.edges.size() == edges);
    const auto by_hand = closure::close(again.volume, again.match).volume;
    CHECK(by_hand.model.points.size() == by_close.model.points.size());
    CHECK(closure::enclosed_volume(by_hand) == closure::enclosed_volume(by_close));
}
