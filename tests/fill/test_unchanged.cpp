// SPDX-License-Identifier: MIT
// A call that fails or is cancelled leaves the volume as it was; one time limit holds for all tries of a
// sweep.
#include "fill/recipe.h"
#include "fill/shapes.h"

#include <lacuna/fill/describe.h>

#include <doctest/doctest.h>

#include <chrono>
#include <regex>
#include <thread>
#include <utility>

using namespace lacuna;
using test::Recipe;

namespace {

/// What a recipe can see of a volume.
const std::string kState = "volume:describe() .. volume:tree() .. tostring(volume) .. #volume:free_edges()";

/// Calls that end with an error.
const std::vector<std::string> kFailing{
    "volume:sweep { size = 0.5, min_scaled_jacobian = 0.9999 }",
    "volume:sweep { size = function() error 'no' end }",
    "volume:sweep { size = 0.5, boundary_layers = { walls = 'nowhere', first = 0.1 } }",
    "volume:sweep_to('/no/such/folder/a.vtk', { size = 0.5 })",
    "lacuna.assembly { volume }:sweep { size = 0.5, min_scaled_jacobian = 0.9999 }",
    "volume:close { void_edges = { { 1, 1 } } }",
    "volume:match { vertices = { { 1, 99 } } }",
    "volume:cut { plane = { { 0, 0, 99 }, { 0, 0, 1 } } }",
};

const std::string kSheared =
    "skin(box(2, 2, 3), function(x, y, z) return { x + z / 3, y + x / 5, z } end, %s)";

std::string sheared(const std::string& drop)
{
    std::string text = kSheared;
    return text.replace(text.find("%s"), 2, drop);
}

const std::vector<std::string> kVolumes{
    "part = " + sheared("nil") + "\nvolume = part:open_volume {}",
    "part = " + sheared("{ ['x2+'] = true, ['y2+'] = true }") +
        "\nvolume = part:open_volume { source = 'z0-', target = 'z3+', walls = { 'x0-', 'y0-' } }",
    "part = " + sheared("{ ['z3+'] = true }") + "\nvolume = part:open_volume {}",
};

} // namespace

TEST_CASE("a failed call of a recipe leaves the volume as before, and the next call is that on a fresh one")
{
    for (const std::string& open : kVolumes) {
        CAPTURE(open);
        Recipe fresh(test::kShapes);
        fresh.run(open + "\nmesh = volume:sweep { size = 0.5, layers = 4 }");
        const sweep::Swept expected = fresh.object<lua::MeshState>("mesh")->swept;
        for (const std::string& call : kFailing) {
            CAPTURE(call);
            Recipe recipe(test::kShapes);
            recipe.run(open);
            const std::string before = recipe.text(kState);
            const std::string code = recipe.code_of(call);
            CHECK(code != "");
            CHECK(recipe.text(kState) == before);
            recipe.run("mesh = volume:sweep { size = 0.5, layers = 4 }");
            CHECK(test::difference(recipe.object<lua::MeshState>("mesh")->swept, expected) == "");
        }
    }
}

TEST_CASE("a cancelled sweep leaves the volume as before, whichever stage it was in")
{
    for (const std::string& open : kVolumes) {
        CAPTURE(open);
        std::vector<std::string> stages;
        std::string stop;
        InterpreterOptions options = Recipe::quiet();
        options.progress = [&](std::string_view stage, double) {
            if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
            return stop.empty() || stage != stop;
        };
        Recipe recipe(test::kShapes, options);
        recipe.run(open);
        const std::string before = recipe.text(kState);
        stages.clear();
        recipe.run("local copy = part:open_volume {}\ncopy:sweep { size = 0.5, layers = 4 }");
        const std::vector<std::string> all = stages;
        CHECK(all.size() > 4);
        for (const std::string& stage : all) {
            if (stage == "roles") continue;
            CAPTURE(stage);
            stop = stage;
            bool cancelled = false;
            try {
                recipe.run("volume:sweep { size = 0.5, layers = 4 }");
            } catch (const Cancelled&) {
                cancelled = true;
            }
            stop.clear();
            CHECK((cancelled || stage == "closing")); // what was sealed as it was read is not closed again
            if (!cancelled) continue;
            CHECK(recipe.text(kState) == before);
        }
    }
}

TEST_CASE("stages give new volumes and leave the old one alone, and each can be called by itself")
{
    Recipe recipe(test::kShapes);
    recipe.run("part = " + sheared("{ ['x2+'] = true }") + "\npart:describe()");
    const topology::Model& model = recipe.object<lua::ModelState>("part")->model;
    const fill::Volume open = fill::open(model);
    const std::string before = fill::describe(open) + fill::tree(open);
    const fill::Volume matched = fill::match(open);
    const fill::Volume sealed = fill::close(matched);
    CHECK_FALSE(open.closure);
    CHECK(sealed.closure);
    CHECK(closure::is_watertight(sealed.volume));
    fill::SweepRequest request;
    request.options.size = [](const Vec3&) { return 0.5; };
    const fill::Filled one = fill::sweep(open, request), other = fill::sweep(sealed, request);
    CHECK(test::difference(fill::parts(one).front(), fill::parts(other).front()) == "");
    request.options.min_scaled_jacobian = 0.9999;
    CHECK(test::code_of([&] { fill::sweep(open, request); }) != "");
    CHECK(test::code_of([&] { fill::match(sealed, matching::MatchOptions{}); }) == "lua.sealed");
    CHECK(fill::describe(open) + fill::tree(open) == before);
    // Pieces of a cut are swept as one.
    const std::vector<fill::Volume> pieces = fill::cut(
        sealed, {geometry::plane_across({0, 0, 1.5}, Vec3::UnitZ()), nullptr, {}});
    REQUIRE(pieces.size() == 2);
    std::vector<fill::Member> members(2);
    for (std::size_t p = 0; p < 2; ++p) members[p].volume = &pieces[p];
    const fill::Filled both = fill::sweep(members);
    CHECK(fill::parts(both).size() == 2);
    CHECK(fill::fidelity(std::get<fill::FilledParts>(both.mesh)).volume ==
          doctest::Approx(closure::enclosed_volume(sealed.volume)));
}

TEST_CASE("seconds of improving are one limit for all that a sweep tries")
{
    // A bent bar whose cells stay below the limit is tried again with wedges. By then the time is over, and
    // nothing moves any more.
    Recipe recipe(test::kShapes);
    recipe.run(
        "part = skin(box(3, 3, 9), function(x, y, z) local r, a = 2 + x + 0.3 * math.sin(z + y), z / 4 "
        "return { r * math.cos(a), y + 0.3 * math.sin(z + x), r * math.sin(a) } end)\npart:describe()");
    fill::Request request;
    sweep::SweepOptions& options = request.sweep.options;
    options.size = [](const Vec3&) { return 0.25; };
    options.min_scaled_jacobian = 0.999;
    options.improving.seconds = 0.3;
    options.fallback = sweep::Fallback::wedges;
    RunContext context;
    std::string with_wedges, last;
    context.log = [&](std::string_view line) {
        if (line.find(", with wedges,") != std::string_view::npos) with_wedges = line;
    };
    bool over = false;
    context.progress = [&](std::string_view stage, double) {
        if (last == "improving" && stage != last && !std::exchange(over, true))
            std::this_thread::sleep_for(std::chrono::milliseconds(400)); // the rest of the time
        last = stage;
    };
    CHECK(test::code_of([&] {
              fill::fill(recipe.object<lua::ModelState>("part")->model, request, context);
          }) == "quality.below_limit");
    REQUIRE(over);
    CAPTURE(with_wedges);
    const std::regex moved(R"(least scaled Jacobian (-?[0-9.]+) before, (-?[0-9.]+) after)");
    int found = 0;
    for (std::sregex_iterator at(with_wedges.begin(), with_wedges.end(), moved), end; at != end; ++at) {
        ++found;
        CHECK((*at)[1] == (*at)[2]);
    }
    CHECK(found > 0);
}

TEST_CASE("work of improving is one limit for all volumes of a call")
{
    // Bent bars whose cells can always be a little better. The first bar uses up the work, and no node of the
    // second bar moves.
    Recipe recipe(test::kShapes);
    recipe.run("local function bar(to) return skin(box(3, 3, 9), function(x, y, z) "
               "local r, a = 2 + x + 0.3 * math.sin(z + y), z / 4 "
               "return { r * math.cos(a), to + y + 0.3 * math.sin(z + x), r * math.sin(a) } end) end\n"
               "first, second = bar(0), bar(20)\nfirst:describe()\nsecond:describe()");
    std::vector<fill::Volume> volumes;
    for (const char* name : {"first", "second"})
        volumes.push_back(fill::open(recipe.object<lua::ModelState>(name)->model, {}));
    std::vector<fill::Member> members(2);
    for (std::size_t m = 0; m < 2; ++m) {
        members[m].volume = &volumes[m];
        members[m].options.size = [](const Vec3&) { return 0.5; };
        members[m].options.improving.good_enough = 0.999;
        members[m].options.improving.work = 1e5;
    }
    const fill::Filled both = fill::sweep(members);
    const std::regex moved(R"(least scaled Jacobian (-?[0-9.]+) before, (-?[0-9.]+) after)");
    std::vector<bool> better;
    for (const std::string& line : fill::report(std::get<fill::FilledParts>(both.mesh))) {
        std::smatch found;
        if (std::regex_search(line, found, moved)) better.push_back(found[1] != found[2]);
    }
    CHECK(better == std::vector<bool>{true, false});
}
