// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/whole_families.h"
#include "surface/sealed.h"

#include <lacuna/core/error.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/shape_size.h>
#include <lacuna/sweep/detail/source_quads.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::SweepOptions;
using sweep::Swept;

namespace {

Swept swept_by_default(const OpenVolume& volume, const SweepOptions& options = {})
{
    Swept swept = sweep::sweep(volume, options);
    test::check_valid(swept.mesh);
    return swept;
}

bool says(const Swept& swept, const std::string& start, const std::string& words)
{
    return std::ranges::any_of(swept.report, [&](const std::string& line) {
        return line.starts_with(start) && line.find(words) != std::string::npos;
    });
}

/// Quads of the source that lines across a place meet, in the mean.
double mean_across(const Swept& swept, double from, double to,
                   const std::function<double(const Vec3&)>& along,
                   const std::function<bool(const Vec3&)>& within)
{
    constexpr int kLines = 60;
    int count = 0;
    for (const Quad& quad : swept.mesh.quads) {
        double low = 1e300, high = -1e300;
        Vec3 centre = Vec3::Zero();
        for (const Index n : quad) {
            const Vec3& p = swept.mesh.nodes[index(n)];
            low = std::min(low, along(p));
            high = std::max(high, along(p));
            centre += p / 4;
        }
        if (!within(centre)) continue;
        for (int i = 0; i < kLines; ++i) {
            const double at = from + (i + 0.4321) / kLines * (to - from);
            count += low < at && at < high ? 1 : 0;
        }
    }
    return static_cast<double>(count) / kLines;
}

} // namespace

TEST_CASE("without a size finer facets make no finer mesh, and the report says the size and the layers")
{
    for (const int sides : {4, 6, 0}) {
        std::size_t least = 0, most = 0;
        for (const int cuts : {sides == 0 ? 6 : 24, sides == 0 ? 12 : 60, sides == 0 ? 24 : 120}) {
            const Swept swept = swept_by_default(test::sealed({.sides = sides, .cuts = cuts}));
            CAPTURE(sides);
            CAPTURE(cuts);
            CHECK(says(swept, "size: ", "[model length] by default, a twentieth of the diagonal"));
            CHECK(says(swept, "layer count: ", "by default"));
            least = least == 0 ? swept.mesh.cell_count() : std::min(least, swept.mesh.cell_count());
            most = std::max(most, swept.mesh.cell_count());
        }
        CHECK(most <= 1.5 * static_cast<double>(least));
    }
}

TEST_CASE("the size and the layers that nobody asked for are logged, once, and nothing where both were asked")
{
    const auto volume = test::sealed({.sides = 4, .cuts = 6});
    for (const bool asked : {false, true}) {
        SweepOptions options;
        if (asked) options.size = [](const Vec3&) { return 0.5; };
        if (asked) options.layers.count = 3;
        std::vector<std::string> lines;
        RunContext context;
        context.log = [&](std::string_view line) { lines.emplace_back(line); };
        const Swept swept = sweep::sweep(volume, options, context);
        CHECK(swept.defaults.size() == (asked ? 0 : 2));
        for (const std::string& line : swept.defaults) {
            CHECK(std::count(lines.begin(), lines.end(), line) == 1);
            CHECK(std::count(swept.report.begin(), swept.report.end(), line) == 1);
        }
    }
}

TEST_CASE("more than 50 million cells are refused unless both the size and the layers are given")
{
    constexpr double kMost = 50e6;
    for (const int sides : {3, 4, 7, 0}) {
        const auto volume = test::sealed({.sides = sides, .cuts = 6});
        const double base = face_area(volume.model, volume.faces(Role::source)[0]);
        for (const double cells : {1e4, 0.9 * kMost, 1.1 * kMost, 1e9}) {
            for (const bool sized : {false, true}) {
                for (const bool counted : {false, true}) {
                    if (!sized && !counted) continue; // the default, which is coarse
                    CAPTURE(sides);
                    CAPTURE(cells);
                    CAPTURE(sized);
                    CAPTURE(counted);
                    SweepOptions options;
                    options.curvature = 0;
                    double side = std::cbrt(base / cells);
                    if (counted) options.layers.count = 1000;
                    if (counted) side = std::sqrt(base * options.layers.count / cells);
                    if (sized) options.size = [side](const Vec3&) { return side; };
                    sweep::KnownLinks links(volume);
                    const sweep::ExpectedCells found =
                        sweep::source_size(volume, options, links, {}).expected;
                    if (sized && counted) CHECK(found.all == doctest::Approx(cells).epsilon(0.01));
                    CHECK(found.unasked == (sized && counted ? 0 : found.all));
                    std::string line;
                    RunContext context;
                    context.log = [&](std::string_view text) { line = text; };
                    std::string code;
                    try {
                        sweep::check_cells(found, context);
                    } catch (const InvalidInput& error) {
                        code = error.code();
                    }
                    CHECK(code == (found.unasked > kMost ? "sweep.many_cells" : ""));
                    CHECK(line.starts_with("estimate: about "));
                }
            }
        }
    }
}

TEST_CASE("sides for a turn count among the cells to be expected, and counts of any size are readable")
{
    const auto volume = test::sealed({.sides = 0, .cuts = 6});
    double before = 0;
    for (const int curvature : {12, 100, 10000, 10000000}) {
        sweep::KnownLinks links(volume);
        SweepOptions options;
        options.curvature = curvature;
        const double now = sweep::source_size(volume, options, links, {}).expected.all;
        CHECK(now > before);
        before = now;
    }
    CHECK(before > 50e6);
    std::string line;
    RunContext context;
    context.log = [&](std::string_view text) { line = text; };
    sweep::check_cells({6.4e19, 0}, context);
    CHECK(line == "estimate: about 6.4e+19 cells");
}

TEST_CASE("with given numbers a loss above 2 % is a note, and the numbers that it names keep the volume")
{
    int notes = 0;
    test::MembersToRun run(5); // four of 18
    for (const int sides : {0, 4}) {
        for (const double belly : {0.6, 1.5, 2.0}) {
            for (const int layers : {2, 4, 30}) {
                if (!run.next()) continue;
                CAPTURE(sides);
                CAPTURE(belly);
                CAPTURE(layers);
                const auto volume = test::sealed({.sides = sides, .cuts = 6, .levels = 24, .belly = belly});
                SweepOptions options;
                options.size = [](const Vec3&) { return 0.4; };
                options.layers.count = layers;
                options.max_deviation = 10;
                const auto off = [](const Swept& swept) {
                    return std::abs(swept.fidelity.volume / swept.fidelity.sealed_volume - 1);
                };
                const Swept swept = sweep::sweep(volume, options);
                REQUIRE(!swept.notes.empty() == (off(swept) > 0.02));
                if (swept.notes.empty()) continue;
                const std::string& note = swept.notes.front();
                ++notes;
                const double size = std::stod(note.substr(note.find("size = ") + 7));
                options.size = [size](const Vec3&) { return size; };
                options.layers.count = std::stoi(note.substr(note.find("layers = ") + 9));
                CHECK(off(sweep::sweep(volume, options)) <= 0.01);
            }
        }
    }
    CHECK(notes > (test::whole_families() ? 3 : 0));
}

TEST_CASE("coarse facets ask for what they are, with some quads across and some layers at least")
{
    const auto volume = test::sealed({.sides = 4, .cuts = 1});
    CHECK(surface::default_size(volume).length == doctest::Approx(std::sqrt(2.0)));
    const Swept swept = swept_by_default(volume);
    CHECK(swept.mesh.quads.size() == sweep::kDefaultGap * sweep::kDefaultGap);
    CHECK(swept.mesh.layers == sweep::kDefaultGap);
    CHECK(says(swept, "size: ", "the mean side of the facets"));
    SweepOptions asked;
    asked.size = [](const Vec3&) { return 10.0; };
    asked.layers.count = 1;
    const Swept one = sweep::sweep(volume, asked);
    CHECK(one.mesh.cell_count() == 1);
    CHECK(!says(one, "size: ", ""));
    CHECK(!says(one, "layer count: ", ""));
}

TEST_CASE("without a size narrow places have two quads across and more in the mean, in facets as in polygons")
{
    int places = 0;
    // Rings, round and square.
    for (const double width : {0.5, 0.2, 0.08}) {
        for (const int sides : {0, 6}) {
            const double inner = 1 - width;
            const auto volume = test::sealed(
                sides == 0
                    ? test::PrismOptions{.sides = 0, .hole_list = {{Vec2(0, 0), inner}}, .cuts = 8}
                    : test::PrismOptions{.sides = 6, .hole_list = {{Vec2(0, 0), 0.866 - width}}, .cuts = 4});
            const Swept swept = swept_by_default(volume);
            CAPTURE(width);
            CAPTURE(sides);
            const auto angle = [](const Vec3& p) { return std::atan2(p.y(), p.x()); };
            CHECK(mean_across(swept, -1, 1, angle, [](const Vec3& p) { return p.x() > 0; }) >= 2);
            // Rows around a ring without corners need no smaller size.
            if (width < 0.1) CHECK(says(swept, "size: ", " wide between ") == (sides > 0));
            ++places;
        }
    }
    // Channels: straight ones, which are mapped, and those with a corner or a neck.
    for (const double w : {1.0, 0.3, 0.1}) {
        const std::vector<std::vector<Vec2>> outlines{
            {{0, 0}, {4, 0}, {4, w}, {0, w}},
            {{0, 0}, {4, 0}, {4, w}, {w, w}, {w, 3}, {0, 3}},
            {{0, 0}, {4, 0}, {4, 3}, {4 - w, 3}, {4 - w, w}, {w, w}, {w, 3}, {0, 3}},
            {{-2, -1},
             {-0.5, -1},
             {-0.5, -w / 2},
             {0.5, -w / 2},
             {0.5, -1},
             {2, -1},
             {2, 1},
             {0.5, 1},
             {0.5, w / 2},
             {-0.5, w / 2},
             {-0.5, 1},
             {-2, 1}}};
        for (std::size_t k = 0; k < outlines.size(); ++k) {
            if (k == 3 && w == 1) continue;
            for (const int cuts : {1, 6}) {
                const Swept swept = swept_by_default(test::sealed({.outline = outlines[k], .cuts = cuts}));
                CAPTURE(w);
                CAPTURE(k);
                CAPTURE(cuts);
                const double low = k == 3 ? -w / 2 : 0, high = k == 3 ? w / 2 : w;
                const double from = k == 3 ? -0.45 : 1.1, to = k == 3 ? 0.45 : 2.9;
                const auto x = [](const Vec3& p) { return p.x(); };
                CHECK(mean_across(swept, from, to, x,
                                  [&](const Vec3& p) { return p.y() > low && p.y() < high; }) >= 2);
                ++places;
            }
        }
    }
    MESSAGE(places << " places");
}

TEST_CASE("a mapped strip has three quads across and is no finer along for it")
{
    for (const double w : {0.1, 0.01}) {
        const Swept swept = swept_by_default(
            test::sealed({.outline = {{0, 0}, {4, 0}, {4, w}, {0, w}}, .cuts = 4}));
        CAPTURE(w);
        CHECK(swept.mesh.quads.size() <= 3 * 20);
    }
}

TEST_CASE("a sliver that nobody asked quads across makes no mesh of millions, and the report says so")
{
    test::MembersToRun run(3); // the widest and the narrowest
    for (const double width : {0.1, 0.02, 1e-3, 3e-4}) {
        if (!run.next()) continue;
        const auto ring = test::sealed({.sides = 0, .hole_list = {{Vec2(0, 0), 1 - width}}, .cuts = 8});
        CAPTURE(width);
        CHECK(swept_by_default(ring).mesh.quads.size() < 1000); // rows around it
        SweepOptions paved;
        paved.quads = sweep::Quads::paved;
        const Swept swept = swept_by_default(ring, paved);
        CHECK(swept.mesh.quads.size() < 5000);
        CHECK(swept.min_scaled_jacobian > 0.5);
        CHECK(says(swept, "size: ", "would give too many quads in total") == (width < 0.01));
    }
}

TEST_CASE("default numbers follow faces that bend between nodes, where coarse numbers are refused")
{
    int refused = 0;
    test::MembersToRun run(3); // three of seven
    const auto check = [&](const test::PrismOptions& options) {
        if (!run.next()) return;
        const auto volume = test::sealed(options);
        const Swept swept = swept_by_default(volume);
        CHECK(swept.fidelity.volume == doctest::Approx(swept.fidelity.sealed_volume).epsilon(0.01));
        SweepOptions asked;
        asked.size = [](const Vec3&) { return 1.0; };
        asked.layers.count = sweep::kDefaultGap;
        try {
            sweep::sweep(volume, asked);
        } catch (const NotSweepable&) {
            ++refused;
        }
    };
    for (const double belly : {2.0, 3.0, 4.0})
        check({.sides = 4, .height = 0.8, .cuts = 1, .levels = 24, .belly = belly});
    for (const double lift : {1.5, 3.0}) {
        check({.sides = 4, .height = 2, .cuts = 1, .target = test::End::bowed, .lift = lift});
        check({.sides = 4, .height = 4, .cuts = 8, .target = test::End::saddle, .lift = lift});
    }
    CHECK(refused > (test::whole_families() ? 1 : 0));
}

TEST_CASE("poor cells are told, whether a size was asked for or not")
{
    for (const double tip : {0.1, 0.2, 3.0}) {
        const auto volume = test::sealed({.outline = {{0, 0}, {4, 0}, {4, tip}}, .cuts = 4});
        const Swept swept = swept_by_default(volume);
        CAPTURE(tip);
        CHECK((swept.min_scaled_jacobian < 0.1) == (tip < 1));
        CHECK(says(swept, "note: ", "the least scaled Jacobian is") == (tip < 1));
        CHECK(swept.notes.size() == (tip < 1 ? 1 : 0));
        SweepOptions asked;
        asked.size = [](const Vec3&) { return 0.5; };
        const Swept sized = sweep::sweep(volume, asked);
        CHECK(says(sized, "note: ", "the least scaled Jacobian is") == (sized.min_scaled_jacobian < 0.3));
    }
}

TEST_CASE("as many walls as may be stacked, each gets a layer by default")
{
    for (const int sides : {0, 3, 4}) {
        for (const int rows : {1, 4, 9}) {
            const auto volume = test::sealed({.sides = sides, .height = 0.5, .cuts = 2, .rows = rows});
            CAPTURE(sides);
            CAPTURE(rows);
            CHECK(swept_by_default(volume).mesh.layers >= rows);
            SweepOptions options;
            options.size = [](const Vec3&) { return 1.0; };
            const Swept swept = sweep::sweep(volume, options);
            test::check_valid(swept.mesh);
            CHECK(swept.mesh.layers >= rows);
        }
    }
}

TEST_CASE("what shape asks of a size costs near linear time in facets")
{
    double before = 0;
    for (const int cuts : {200, 800, 3200}) { // 24 times as many on both rims
        if (cuts > 800 && !test::whole_families()) continue;
        const auto volume = test::sealed({.sides = 0, .hole_list = {{Vec2(0, 0), 0.97}}, .cuts = cuts});
        const double size = surface::default_size(volume).length;
        const std::clock_t start = std::clock();
        const auto shape = surface::shape_size(volume, [size](const Vec3&) { return size; }, {12, 2});
        const double now = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        REQUIRE(shape.width);
        CHECK(shape.width->width == doctest::Approx(0.03).epsilon(0.01));
        const int facets = 24 * cuts;
        MESSAGE(facets << " sides: " << now << " s");
        CHECK((before == 0 || now < 4 * 4 * before + 0.05)); // four times the facets
        before = now;
    }
}
