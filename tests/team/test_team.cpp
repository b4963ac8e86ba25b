// SPDX-License-Identifier: MIT
#include "support/folder.h"
#include "support/quad_meshers.h"
#include "surface/sealed.h"
#include "sweep/layers_of.h"
#include "thread_crew.h"

#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

using namespace lacuna;
using test::ThreadCrew;

namespace {

sweep::Swept swept_by(const Crew* crew, const test::PrismOptions& shape, int layers, double size)
{
    const topology::OpenVolume volume = test::sealed(shape);
    sweep::SweepOptions options = test::layers_of(layers, size);
    options.layered = true;
    options.crew = crew;
    return sweep::sweep(volume, options);
}

std::string written_by(const Crew* crew, const sweep::Swept& swept, const std::string& ending,
                       const team::LayeredFile& file)
{
    const test::Folder folder;
    const std::string path = folder.file("mesh" + ending);
    team::write_layered({swept.mesh, *swept.layers}, *swept.plan, path, file, crew, {});
    CHECK(folder.entries() == 1);
    return test::bytes_of(path);
}

const std::vector<std::pair<std::string, team::LayeredFile>> kFiles{
    {".msh", {}},
    {".msh", {true, 4.1, {quality::Metric::scaled_jacobian, quality::Metric::volume}}},
    {".msh", {false, 4.1, {quality::Metric::scaled_jacobian}}},
    {".msh", {true, 2.2, {}}},
    {".msh", {false, 2.2, {}}},
    {".vtu", {true, 4.1, {quality::Metric::scaled_jacobian}}},
    {".vtk", {true, 4.1, {quality::Metric::shape}}},
    {".vtk", {false, 4.1, {quality::Metric::shape}}},
    {".msh", {.partition = {3, 1}}},
    {".msh", {.binary = false, .quality = {quality::Metric::shape}, .partition = {2, 0}}},
    {".inp", {.material = "steel"}},
    {".bdf", {}},
    {".unv", {}}};

} // namespace

TEST_CASE("shares follow each other, are all there is, and differ by one at most")
{
    for (const std::size_t count : {0, 1, 3, 7, 64, 1001})
        for (const std::size_t size : {1, 2, 3, 8}) {
            std::size_t at = 0;
            for (std::size_t rank = 0; rank < size; ++rank) {
                const auto [begin, end] = share_of(rank, size, count);
                CHECK(begin == at);
                CHECK(end - begin >= count / size);
                CHECK(end - begin <= count / size + 1);
                at = end;
            }
            CHECK(at == count);
        }
}

TEST_CASE("a mesh made and written by any number is that of one, to the byte")
{
    struct Case {
        test::PrismOptions shape;
        int layers;
        double size;
    };
    const std::vector<Case> cases{{{.sides = 6, .twist = 20}, 7, 0.3},
                                  {{.sides = 8, .holes = 2, .taper = 0.7}, 5, 0.25},
                                  {{.bend = 40}, 60, 0.02}}; // in several parts
    for (const Case& own : cases) {
        const sweep::Swept one = swept_by(nullptr, own.shape, own.layers, own.size);
        REQUIRE(one.layers);
        for (const int size : {2, 3, 4}) {
            CAPTURE(size);
            ThreadCrew crew(size);
            const sweep::Swept all = swept_by(&crew.crew, own.shape, own.layers, own.size);
            REQUIRE(all.layers);
            CHECK(crew.calls > 0);
            CHECK(all.report == one.report);
            CHECK(all.min_scaled_jacobian == one.min_scaled_jacobian);
            for (std::size_t f = 0; f < (own.layers < 20 ? kFiles.size() : 2); ++f) {
                CAPTURE(f);
                const auto& [ending, file] = kFiles[f];
                CHECK(written_by(&crew.crew, all, ending, file) == written_by(nullptr, one, ending, file));
            }
            crew.join();
            CHECK(crew.failed == 0);
        }
    }
}

TEST_CASE("pieces made by any number are those of one, to the byte, and one that fails leaves none")
{
    const sweep::Swept one = swept_by(nullptr, {.sides = 6, .twist = 20}, 7, 0.3);
    REQUIRE(one.layers);
    const auto write = [&](const Crew* crew, const test::Folder& folder, int parts) {
        const team::LayeredFile file{.quality = {quality::Metric::shape}, .partition = {parts, 1}};
        team::write_layered({one.mesh, *one.layers}, *one.plan, folder.file("mesh.pvtu"), file, crew, {});
    };
    for (const int parts : {1, 3, 7}) {
        const test::Folder alone;
        write(nullptr, alone, parts);
        CHECK(alone.entries() == std::size_t(parts) + 1);
        for (const int size : {2, 4}) {
            ThreadCrew crew(size);
            const test::Folder together;
            write(&crew.crew, together, parts);
            crew.join();
            CHECK(together.entries() == std::size_t(parts) + 1);
            for (int p = -1; p < parts; ++p) {
                const std::string name = p < 0 ? "mesh.pvtu" : "mesh_" + std::to_string(p) + ".vtu";
                CHECK(test::bytes_of(together.file(name)) == test::bytes_of(alone.file(name)));
            }
        }
    }
    for (const int rank : {0, 2}) {
        ThreadCrew crew(3);
        crew.broken = rank;
        const test::Folder folder;
        CHECK(test::error_code([&] { write(&crew.crew, folder, 3); }) == "test.broken");
        CHECK(folder.entries() == 0);
    }
    const test::Folder folder;
    CHECK(test::error_code([&] { write(nullptr, folder, 8); }) == "io.too_many_parts");
    CHECK(folder.entries() == 0);
}

TEST_CASE("a mesh that is refused is refused alike by any number")
{
    const auto code_by = [](const Crew* crew) {
        return test::error_code([&] {
            const topology::OpenVolume volume = test::sealed({.sides = 6, .twist = 20});
            sweep::SweepOptions options = test::layers_of(4, 0.3);
            options.layered = true;
            options.improve = false;
            options.min_scaled_jacobian = 0.99999;
            options.crew = crew;
            sweep::sweep(volume, options);
        });
    };
    ThreadCrew crew(3);
    CHECK(code_by(&crew.crew) == code_by(nullptr));
    CHECK(code_by(nullptr) == "quality.below_limit");
}

TEST_CASE("where one fails all end, the first says who and why, and no file is left")
{
    for (const int rank : {0, 1, 2}) {
        CAPTURE(rank);
        ThreadCrew crew(3);
        const sweep::Swept swept = swept_by(&crew.crew, {}, 4, 0.4);
        const test::Folder folder;
        const auto write = [&](const std::string& ending) {
            team::write_layered({swept.mesh, *swept.layers}, *swept.plan, folder.file("mesh" + ending), {},
                                &crew.crew, {});
        };
        crew.broken = rank;
        std::string message;
        try {
            write(".msh");
        } catch (const Error& error) {
            CHECK(error.code() == "test.broken");
            message = error.what();
        }
        CHECK(message.find("the disk is gone") != std::string::npos);
        CHECK((message.find("process " + std::to_string(rank + 1) + " of 3") != std::string::npos) ==
              (rank > 0));
        CHECK(folder.entries() == 0);
        crew.broken = -1;
        crew.cancelled = rank;
        CHECK_THROWS_AS(write(".vtu"), Cancelled);
        CHECK(folder.entries() == 0);
        crew.cancelled = -1;
        CHECK_NOTHROW(write(".vtk")); // and they help again
        CHECK(folder.entries() == 1);
    }
}

TEST_CASE("an error of one process reaches the others with its entities and remedy")
{
    const NamedEntity face{"face", 3, "lid"};
    std::string told;
    Team failing;
    failing.exchange = [&](const std::string& own) {
        told = own;
        return std::vector<std::string>{own};
    };
    const auto fail = [&] {
        throw NotSweepable(Message("test.folds", "{} folds", face).remedy("take {} layers", needed(4)));
    };
    CHECK_THROWS_AS(do_together(&failing, fail), NotSweepable);
    Team other;
    other.exchange = [&](const std::string& own) { return std::vector<std::string>{own, told}; };
    bool heard = false;
    try {
        gather(&other, {});
    } catch (const TeamFailed& error) {
        heard = true;
        CHECK(error.what() == std::string("process 2 of 2: face 3 \"lid\" folds; take 4 layers"));
        CHECK(error.code() == "test.folds");
        CHECK(error.message().remedy() == "take 4 layers");
        REQUIRE(error.message().entities() == std::vector<NamedEntity>{face});
        CHECK(error.message().entities()[0].name == "lid");
        CHECK(error.message().needed() == std::vector<MessageValue>{4LL});
    }
    CHECK(heard);
}

TEST_CASE("what each is told does not grow with the layers but for the rims")
{
    struct Counted {
        ThreadCrew crew{2};
        Crew counting;
        std::size_t bytes = 0;
        Counted()
        {
            counting.size = 2;
            counting.call = [this](std::string_view task, const std::string& told) -> const Team& {
                bytes += told.size();
                return crew.crew.call(task, told);
            };
        }
    };
    const auto told = [](int layers) {
        Counted counted;
        const sweep::Swept swept = swept_by(&counted.counting, {}, layers, 0.1);
        written_by(&counted.counting, swept, ".msh", {});
        return std::pair(counted.bytes, swept.mesh.rim.size());
    };
    const auto [few, rim] = told(5);
    const auto [many, same] = told(25);
    REQUIRE(rim == same);
    // A point of the rim and a height for each task, and a patch of a wall's side: 24 + 24 + 4 bytes.
    CHECK(many - few <= 20 * (rim * 52 + 16));
}
