// SPDX-License-Identifier: MIT
#include "two_ends.h"

#include <lacuna/matching/match.h>

#include <map>
#include <random>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using matching::Match;
using matching::MatchOptions;
using matching::Method;
using test::Ends;
using test::lifted;
using test::Place;
using test::polygon;
using test::refusal;
using test::regular;
using test::two_ends;

namespace {

MatchOptions nearest()
{
    MatchOptions options;
    options.method = Method::nearest;
    return options;
}

std::map<int, int> partners(const OpenVolume& volume, const Match& found)
{
    std::map<int, int> result;
    for (const auto& [s, t] : found.vertices) result[volume.model[s].tag] = volume.model[t].tag;
    return result;
}

/// One-to-one, loop by loop, and in order along the loops; hard flags and vertices as many.
void check_map(const OpenVolume& volume, const Match& found)
{
    std::set<VertexId> sources, targets;
    for (const auto& [s, t] : found.vertices) {
        CHECK(sources.insert(s).second);
        CHECK(targets.insert(t).second);
    }
    CHECK(found.hard.size() == found.vertices.size());
    CHECK(found.confidence >= 0);
    CHECK(found.confidence <= 1);
    std::map<VertexId, VertexId> partner(found.vertices.begin(), found.vertices.end());
    std::set<int> used;
    for (const auto& pair : found.loops) {
        CHECK(used.insert(pair.target).second);
        const auto& low = found.source_loops[static_cast<std::size_t>(pair.source)].uses;
        const auto& high = found.target_loops[static_cast<std::size_t>(pair.target)].uses;
        REQUIRE(low.size() == high.size());
        std::vector<std::size_t> at;
        for (const EdgeUse& use : low) {
            const VertexId t = partner.at(use_from(volume.model, use));
            std::size_t j = 0;
            while (j < high.size() && use_from(volume.model, high[j]) != t) ++j;
            REQUIRE(j < high.size());
            at.push_back(j);
        }
        const std::size_t n = at.size();
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t step = (at[(i + 1) % n] + n - at[i]) % n;
            CHECK(step == (n == 1 ? 0 : pair.flipped ? 1 : n - 1));
        }
    }
}

/// Unlike corners on an outer loop, and holes apart from each other.
Ends plate(int corners, int holes, std::mt19937& dice)
{
    std::uniform_real_distribution<double> chance(-1, 1);
    Ends ends;
    for (int l = 0; l <= holes; ++l) {
        std::vector<Vec2> outline = regular(l == 0 ? corners : 3 + l, l == 0 ? 10 : 0.6);
        const double angle = 2 * std::numbers::pi * l / std::max(holes, 1) + 0.3;
        for (Vec2& p : outline) {
            p *= 1 + 0.1 * chance(dice);
            if (l > 0) p += 2.7 * Vec2(std::cos(angle), std::sin(angle));
        }
        ends.push_back(polygon(outline, 2));
    }
    return ends;
}

/// Least distance between two vertices of an end.
double spacing(const Ends& ends)
{
    std::vector<Vec2> all;
    for (const auto& outline : ends) {
        for (const std::size_t v : outline.vertices) all.push_back(outline.points[v]);
    }
    double least = 1e30;
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) least = std::min(least, (all[i] - all[j]).norm());
    }
    return least;
}

} // namespace

TEST_CASE("nearest undoes every motion that takes no vertex half way to the next")
{
    std::mt19937 dice(21);
    std::uniform_real_distribution<double> chance(-1, 1);
    int combinations = 0;
    for (int corners = 3; corners <= 9; ++corners) {
        for (int holes = 0; holes <= 3; ++holes) {
            for (int trial = 0; trial < 6; ++trial) {
                const Ends ends = plate(corners, holes, dice);
                // No vertex moves in the plane by more than this; height adds to all distances alike.
                const double reach = 0.45 * spacing(ends);
                const double turn = 0.2 * reach / 12 * chance(dice),
                             scale = 1 + 0.2 * reach / 12 * chance(dice);
                const Vec2 shift(0.4 * reach * chance(dice), 0.4 * reach * chance(dice));
                const auto volume = two_ends(ends, ends, lifted(3 + 20 * (trial % 3), scale, turn, shift));
                CAPTURE(corners);
                CAPTURE(holes);
                CAPTURE(trial);
                const Match found = matching::match(volume, nearest());
                CHECK(found.method == "nearest");
                check_map(volume, found);
                // Vertices of both ends are numbered alike.
                const int half = static_cast<int>(volume.model.vertices.size()) / 2;
                for (const auto& [s, t] : partners(volume, found)) CHECK(t == s + half);
                CHECK(partners(volume, found) == partners(volume, matching::match(volume)));
                ++combinations;
            }
        }
    }
    MESSAGE(combinations << " motions");
}

TEST_CASE("a map that is not unique is cured by the reverse distances")
{
    // A target drawn to one side: several source vertices have the same nearest, each target vertex but one
    // has its own.
    int cured = 0, refusals = 0;
    std::mt19937 dice(22);
    std::uniform_real_distribution<double> chance(-1, 1);
    for (int trial = 0; trial < 400; ++trial) {
        const Ends ends = plate(3 + trial % 6, 0, dice);
        const Vec2 shift(8 * chance(dice), 8 * chance(dice));
        const auto volume = two_ends(ends, ends, lifted(2, 0.3 + 0.2 * chance(dice), 0, shift));
        std::set<VertexId> met;
        const auto& model = volume.model;
        const std::size_t half = model.vertices.size() / 2;
        for (std::size_t s = 0; s < half; ++s) {
            std::size_t best = half;
            for (std::size_t t = half; t < 2 * half; ++t) {
                const Vec3& p = model.at(model.vertices[s].point);
                if ((model.at(model.vertices[t].point) - p).norm() <
                    (model.at(model.vertices[best].point) - p).norm())
                    best = t;
            }
            met.insert(VertexId(best));
        }
        if (met.size() == half) continue;
        const std::string code = refusal([&] {
            const Match found = matching::match(volume, nearest());
            check_map(volume, found);
            ++cured;
        });
        if (code != "done") {
            CHECK(code == "matching.nearest_failed");
            ++refusals;
        }
    }
    CHECK(cured > 10);
    CHECK(refusals > 10);
    MESSAGE(cured << " maps cured, " << refusals << " refused");
}

TEST_CASE("whatever the motion, nearest gives a map that is one-to-one and in order, or says which loop it "
          "fails for")
{
    int given = 0, refusals = 0;
    std::mt19937 dice(23);
    std::uniform_real_distribution<double> chance(-1, 1);
    for (int trial = 0; trial < 600; ++trial) {
        const Ends ends = plate(3 + trial % 7, trial % 4, dice);
        const auto volume = two_ends(ends, ends,
                                     lifted(5 * (1 + chance(dice)), std::exp(chance(dice)),
                                            std::numbers::pi * chance(dice),
                                            Vec2(15 * chance(dice), 15 * chance(dice))));
        const std::string code = refusal(
            [&] {
                check_map(volume, matching::match(volume, nearest()));
                ++given;
            },
            {});
        if (code == "done") continue;
        ++refusals;
        CHECK((code == "matching.nearest_failed" || code == "matching.edge_counts"));
        refusal([&] { matching::match(volume, nearest()); }, {"source loop", "aligned"});
    }
    CHECK(given > 50);
    CHECK(refusals > 50);
    MESSAGE(given << " maps, " << refusals << " refusals");
}

TEST_CASE("far, turned and concentric ends, which defeat the nearest vertex, are refused with loops and "
          "vertices named")
{
    const Ends square{polygon(regular(4))};
    // Far: all source vertices are nearest to the same target vertex, and the other way round.
    const auto far = two_ends(square, square, lifted(1, 1, 0.1, {40, 3}));
    CHECK(refusal([&] { matching::match(far, nearest()); },
                  {"source loop 1", "(vertex ", "both nearest to vertex"}) == "matching.nearest_failed");
    // Concentric: the holes' vertices of a ring that opens are nearest to its outer loop's.
    const Ends thick{polygon(regular(6, 10)), polygon(regular(6, 2))};
    const Ends thin{polygon(regular(6, 2.4)), polygon(regular(6, 2))};
    const auto drawn = two_ends(thick, thin, lifted(1));
    check_map(drawn, matching::match(drawn, nearest()));
    const Ends inner{polygon(regular(6, 10)), polygon(regular(6, 9))};
    const Ends outer{polygon(regular(6, 30)), polygon(regular(6, 12))};
    const auto grown = two_ends(inner, outer, lifted(1));
    CHECK(refusal([&] { matching::match(grown, nearest()); }, {"source loop"}) == "matching.nearest_failed");
    CHECK_NOTHROW(matching::match(grown)); // aligned does not mind
    // A turn of a step of a regular loop comes out as no turn: one-to-one, so it cannot know; half a step is
    // a toss-up, and it says so.
    const auto half = two_ends(square, square, lifted(1, 1, std::numbers::pi / 4 + 1e-9));
    const std::string code = refusal([&] { CHECK(matching::match(half, nearest()).confidence < 0.01); });
    CHECK((code == "done" || code == "matching.nearest_failed"));
}

TEST_CASE("an outlier of distance follows the others of its loop, and a note names it")
{
    // One corner of the target is drawn out, so that its place is taken by a neighbour.
    std::vector<Vec2> low = regular(12, 10), high = low;
    high[0] = Vec2(10, 0) * 0.55 + Vec2(0, 7.5);
    high[1] = Vec2(9.0, 7.0);
    const auto volume = two_ends({polygon(low, 2)}, {polygon(high, 2)}, lifted(1));
    const std::string code = refusal([&] {
        const Match found = matching::match(volume, nearest());
        check_map(volume, found);
        for (const auto& [s, t] : partners(volume, found)) CHECK(t == s + 12);
        REQUIRE(!found.notes.empty());
        CHECK(found.notes.front().code() == "matching.nearest_taken");
        CHECK(found.confidence < 1);
    });
    CHECK(code == "done");
}

TEST_CASE("unlike numbers of edges are refused by nearest, with both, and taken by aligned")
{
    const auto volume = two_ends({polygon(regular(5))}, {polygon(regular(4))}, lifted(1));
    CHECK(refusal([&] { matching::match(volume, nearest()); },
                  {"source loop 1 has 5 edges", "has 4", "aligned"}) == "matching.edge_counts");
    CHECK_NOTHROW(matching::match(volume));
}

TEST_CASE("a refusal of nearest names the other method where that matches, and only there")
{
    const Ends square{polygon(regular(4))};
    const std::vector<OpenVolume> refused{
        two_ends(square, square, lifted(1, 1, 0.1, {40, 3})),
        two_ends({polygon(regular(6, 10)), polygon(regular(6, 9))},
                 {polygon(regular(6, 30)), polygon(regular(6, 12))}, lifted(1)),
        two_ends({polygon(regular(5))}, {polygon(regular(4))}, lifted(1)),
    };
    std::size_t helped = 0, not_helped = 0;
    for (const OpenVolume& volume : refused) {
        const Model& model = volume.model;
        const Rim from = rims(model, volume.faces(Role::source)).front();
        const Rim to = rims(model, volume.faces(Role::target)).front();
        const auto pair = [&](std::size_t s, std::size_t t) {
            return std::pair(model[use_from(model, from.uses[s])].tag,
                             model[use_from(model, to.uses[t])].tag);
        };
        // As they are, and by pairs that go round one loop against the other's order.
        for (const bool crossed : {false, true}) {
            MatchOptions options = nearest();
            if (crossed) options.vertices = {pair(0, 0), pair(1, 2), pair(2, 1), pair(3, 3)};
            MatchOptions aligned = options;
            aligned.method = matching::Method::aligned;
            const std::string code = refusal([&] { matching::match(volume, aligned); });
            std::string message;
            try {
                matching::match(volume, options);
            } catch (const Error& error) {
                message = error.what();
            }
            CAPTURE(message);
            CHECK(!message.empty());
            CHECK((message.find("aligned") != std::string::npos) == (code == "done"));
            ++(code == "done" ? helped : not_helped);
        }
    }
    CHECK(helped >= refused.size());
    CHECK(not_helped > 0);
}

TEST_CASE("vertices, loops and flip given by hand are obeyed by nearest, and contradictions refused by tag")
{
    std::mt19937 dice(24);
    const Ends ends = plate(5, 0, dice);
    const auto volume = two_ends(ends, ends, lifted(2));
    const Match free = matching::match(volume, nearest());
    const auto as_found = partners(volume, free);
    for (int shift = 0; shift < 5; ++shift) {
        // Every pair of the same turn can be given, and turns the whole loop with it.
        MatchOptions options = nearest();
        for (int i = 0; i < 3; ++i) options.vertices.emplace_back(1 + i, 6 + (i + shift) % 5);
        const Match found = matching::match(volume, options);
        check_map(volume, found);
        for (const auto& [s, t] : partners(volume, found)) CHECK(t == 6 + (s - 1 + shift) % 5);
    }
    MatchOptions flip = nearest();
    flip.flip = {0};
    const Match flipped = matching::match(volume, flip);
    check_map(volume, flipped);
    CHECK(flipped.loops[0].flipped != free.loops[0].flipped);
    MatchOptions crossed = nearest();
    crossed.vertices = {{1, 6}, {2, 8}};
    CHECK(refusal([&] { matching::match(volume, crossed); }, {"source loop 1"}) != "done");
    MatchOptions unknown = nearest();
    unknown.vertices = {{1, 2}};
    CHECK(refusal([&] { matching::match(volume, unknown); }, {"vertex 2"}) == "matching.unknown_vertex");
    MatchOptions twice = nearest();
    twice.vertices = {{1, 6}, {1, 7}};
    CHECK(refusal([&] { matching::match(volume, twice); }, {"vertex 1", "6", "7"}) ==
          "matching.vertices_contradict");
    MatchOptions shared = nearest();
    shared.vertices = {{1, 6}, {2, 6}};
    CHECK(refusal([&] { matching::match(volume, shared); }, {"6"}) == "matching.vertices_contradict");

    // Two holes of a kind: sent to each other's place by hand.
    const Ends two{polygon(regular(4, 10)), polygon({{2, -1}, {4, -1}, {4, 1}, {2, 1}}),
                   polygon({{-4, -1}, {-2, -1}, {-2, 1}, {-4, 1}})};
    const auto holes = two_ends(two, two, lifted(1));
    const Match plain = matching::match(holes, nearest());
    REQUIRE(plain.loops.size() == 3);
    MatchOptions swapped = nearest();
    swapped.loops = {{1, plain.loops[2].target}, {2, plain.loops[1].target}};
    // Their nearest sides clash; a pair of vertices each settles it.
    CHECK(refusal([&] { matching::match(holes, swapped); }, {"source loop"}) == "matching.nearest_failed");
    const auto loop_tags = [&](const Match& found, int loop) {
        std::vector<int> result;
        for (const EdgeUse& use : found.source_loops[static_cast<std::size_t>(loop)].uses)
            result.push_back(holes.model[use_from(holes.model, use)].tag);
        return result;
    };
    const auto plain_tags = partners(holes, plain);
    swapped.vertices = {{loop_tags(plain, 1)[0], plain_tags.at(loop_tags(plain, 2)[0])},
                        {loop_tags(plain, 2)[0], plain_tags.at(loop_tags(plain, 1)[0])}};
    const Match found = matching::match(holes, swapped);
    check_map(holes, found);
    CHECK(found.loops[1].target == plain.loops[2].target);
    CHECK(found.loops[2].target == plain.loops[1].target);
    for (const auto& pair : swapped.vertices) CHECK(partners(holes, found).at(pair.first) == pair.second);
    MatchOptions both = nearest();
    both.loops = {{1, 1}, {2, 1}};
    CHECK(refusal([&] { matching::match(holes, both); }, {"loop"}) != "done");
}
