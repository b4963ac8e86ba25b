// SPDX-License-Identifier: MIT
#include "support/cancelling.h"
#include "support/folder.h"
#include "support/volumes.h"
#include "support/whole_families.h"

#include <lacuna/closure/close.h>
#include <lacuna/io/deck_file.h>
#include <lacuna/io/mesh_file.h>
#include <lacuna/matching/match.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <functional>
#include <optional>
#include <random>
#include <vector>

using namespace lacuna;
using test::without;

TEST_CASE("whatever stage a cancel comes in, the work stops within half a second and leaves no file")
{
    // 0.2 s is what it is to be; the rest is for builds that check themselves.
    constexpr double kAllowed = 0.5;
    constexpr int kMoments = 12;
    std::mt19937 random(17);
    test::MembersToRun run(2);
    const auto try_all = [&](const char* name, const topology::OpenVolume& open,
                             const sweep::SweepOptions& options, const std::string& ending) {
        CAPTURE(name);
        const test::Folder folder;
        const std::string path = folder.file("mesh" + ending);
        const auto work = [&](const RunContext& context) {
            topology::OpenVolume volume = open;
            const bool ends = !volume.faces(topology::Role::source).empty() &&
                              !volume.faces(topology::Role::target).empty();
            const matching::Match match = ends ? matching::match(volume, {}, context) : matching::Match{};
            volume = closure::close(volume, match, {}, context).volume;
            const sweep::Swept swept = sweep::sweep(volume, options, context);
            const io::Format& format = io::needed_mesh_format("write", path);
            if (swept.layers)
                io::write_mesh(format, {swept.mesh, *swept.layers}, path, {}, {}, {}, context);
            else
                io::write_mesh(format, swept.mesh, path, {}, {}, context);
        };
        const double before = test::processor_time();
        RunContext alone;
        alone.threads = 1;
        work(alone);
        const double whole = test::processor_time() - before;
        CHECK(folder.entries() == 1);
        std::filesystem::remove(path);
        std::uniform_real_distribution<double> moment(0, 0.95 * whole);
        for (int i = 0; i < kMoments; ++i) {
            const double at = moment(random);
            if (!run.next()) continue;
            CAPTURE(whole);
            CAPTURE(at);
            const std::optional<double> after = test::stops_after(at, test::processor_time, alone, work);
            if (after) CHECK(*after < kAllowed);
            CHECK(folder.entries() == (after ? 0 : 1));
            std::filesystem::remove(path);
        }
    };
    const auto options_of = [](int layers, double size) {
        sweep::SweepOptions options;
        options.layers.count = layers;
        options.size = [size](const Vec3&) { return size; };
        return options;
    };
    const topology::OpenVolume disc = test::prism({.sides = 48, .drop = without(false, false, true)}).open();
    try_all("paved and written", disc, options_of(20, 0.02), ".msh");
    sweep::SweepOptions layered = options_of(60, 0.02);
    layered.layered = true;
    try_all("written as it is made", disc, layered, ".msh");
    try_all("a deck", disc, options_of(10, 0.02), ".inp");
    try_all("bent, of many facets",
            test::prism({.sides = 4,
                         .height = 5,
                         .cuts = 40,
                         .levels = 60,
                         .bend = 90,
                         .drop = without(false, false, false, {0})})
                .open(),
            options_of(30, 0.05), ".vtu");
    sweep::SweepOptions second = options_of(8, 0.04);
    second.order = 2;
    try_all("of order 2", disc, second, ".vtu");
    sweep::SweepOptions strict = options_of(12, 0.08);
    strict.improving.good_enough = 0.95; // so that nodes are moved
    try_all("improved", test::prism({.sides = 4, .levels = 6, .twist = 60}).open(), strict, ".msh");
}
