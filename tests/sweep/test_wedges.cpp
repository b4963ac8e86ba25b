// SPDX-License-Identifier: MIT
#include "given_skins.h"

using namespace lacuna;
using namespace lacuna::test;

namespace {

/// Which quads of an end are given as two triangles each.
struct Mix {
    const char* name;
    std::function<bool(const Vec3& before)> split;
};

const std::vector<Mix> kMixes{
    {"half", [](const Vec3& p) { return p.x() > 0.5; }},
    {"corner", [](const Vec3& p) { return p.x() < 0.3 && p.y() < 0.3; }},
    {"scattered", [](const Vec3& p) { return std::sin(40 * p.x() + 17 * p.y()) > 0.4; }},
    {"all", [](const Vec3&) { return true; }},
};

/// A block whose ends are given as quads and triangles.
Opened mixed_block(const Mix& mix, const Missing& gone, Vec3 (*map)(const Vec3&))
{
    const test::BlockOptions plain{.columns = 5, .rows = 4, .layers = 3};
    test::BlockOptions moved = plain;
    moved.map = map;
    const GivenSkin before = skin_of(test::block(plain));
    std::size_t next = 0;
    return open(skin_of(test::block(moved)), [&](int part, const Vec3&) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : before.quads[next]) centre += before.nodes[static_cast<std::size_t>(n)] / 4;
        ++next;
        if (gone.gone(part, centre)) return Given::no;
        return part < 2 && mix.split(centre) ? Given::triangles : Given::quads;
    });
}

SweepOptions with_wedges(int layers = 0)
{
    SweepOptions options;
    options.wedges = true;
    options.layers.count = layers;
    return options;
}

bool says(const Swept& swept, const std::string& words)
{
    return std::any_of(swept.report.begin(), swept.report.end(),
                       [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

} // namespace

TEST_CASE("given quads and triangles of both ends are faces of the mesh with wedges, in every class")
{
    int meshed = 0;
    for (Vec3 (*map)(const Vec3&) : {uneven, twisted, bent}) {
        for (const Mix& mix : kMixes) {
            for (const Missing& gone : kMissing) {
                const std::string value = gone.value;
                Opened opened = mixed_block(mix, gone, map);
                CAPTURE(mix.name);
                CAPTURE(value);
                const Swept result = filled(opened.volume, with_wedges(value == "I" ? 3 : 0));
                test::check_valid(result.mesh);
                CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
                CHECK(kept(result.mesh, opened.triangles) == opened.triangles.size());
                if (value != "V") CHECK(result.mesh.wedge_count() > 0);
                CHECK(result.mesh.hex_count() + result.mesh.wedge_count() == result.mesh.cell_count());
                ++meshed;
            }
        }
    }
    MESSAGE(meshed << " blocks, every given quad and triangle kept");
}

TEST_CASE("an end of quads and triangles without wedges is an error that counts both and names the option")
{
    const Mix half{"half", [](const Vec3& p) { return p.x() > 0.5; }};
    for (const Missing& gone : kMissing) {
        if (std::string(gone.value) == "V") continue;
        CAPTURE(gone.value);
        Opened opened = mixed_block(half, gone, uneven);
        SweepOptions options;
        options.layers.count = 3;
        CHECK(test::refusal([&] { filled(opened.volume, options); },
                            {"12 quads and 16 triangles", "wedges = true", "source"}) ==
              "surface.given_triangles");
        options.quads = sweep::Quads::paved;
        const Swept anew = filled(opened.volume, options);
        test::check_valid(anew.mesh);
        CHECK(anew.mesh.wedge_count() == 0);
        CHECK(says(anew, "12 quads and 16 triangles"));
    }
}

TEST_CASE("an end of triangles alone is a shape without wedges: it is meshed anew inside its rim")
{
    const Mix all{"all", [](const Vec3&) { return true; }};
    Opened opened = mixed_block(all, kMissing[3], uneven);
    const Swept anew = filled(opened.volume, {});
    test::check_valid(anew.mesh);
    CHECK(anew.mesh.wedge_count() == 0);
    CHECK(kept(anew.mesh, opened.quads) == opened.quads.size());
}

TEST_CASE("a rim with an odd number of given sides costs one triangle with wedges, and every quad stays")
{
    for (int sides = 5; sides < 40; sides += 2) {
        for (const double waves : {0.0, 0.25}) {
            CAPTURE(sides);
            CAPTURE(waves);
            const GivenSkin ring = skin_of(test::ring(sides, 4));
            GivenSkin skin = ring;
            for (Vec3& p : skin.nodes)
                p.head<2>() *= 1 + waves * std::sin(3 * std::atan2(p.y(), p.x()) + p.z());
            std::size_t next = 0;
            Opened opened = open(skin, [&](int part, const Vec3&) {
                Vec3 centre = Vec3::Zero();
                for (const Index n : ring.quads[next]) centre += ring.nodes[static_cast<std::size_t>(n)] / 4;
                ++next;
                return part == 2 && centre.head<2>().norm() > 1.4 ? Given::quads : Given::no;
            });
            const Swept result = filled(opened.volume, with_wedges());
            test::check_valid(result.mesh);
            CHECK(result.mesh.triangle_count() == 1);
            CHECK(result.mesh.wedge_count() == static_cast<std::size_t>(result.mesh.layers));
            CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
            CHECK(result.min_scaled_jacobian > 0.2);
            CHECK(says(result, "an odd number"));
        }
    }
}

TEST_CASE("a rim with an even number of sides has no triangle with wedges")
{
    const GivenSkin skin = skin_of(test::ring(12, 4));
    Opened opened = open(skin, [](int part, const Vec3& p) {
        return part == 2 && p.head<2>().norm() > 1.4 ? Given::quads : Given::no;
    });
    const Swept result = filled(opened.volume, with_wedges());
    CHECK(result.mesh.wedge_count() == 0);
    CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
}

TEST_CASE("a mesh with wedges is the same for any number of threads, and so are its cells' layers")
{
    Opened opened = mixed_block(kMixes[2], kMissing[3], bent);
    opened.volume = closure::close(opened.volume, matching::Match{}).volume;
    RunContext one, four;
    one.threads = 1;
    four.threads = 4;
    const Swept a = sweep::sweep(opened.volume, with_wedges(), one);
    const Swept b = sweep::sweep(opened.volume, with_wedges(), four);
    CHECK(a.mesh.nodes == b.mesh.nodes);
    CHECK(a.mesh.quads == b.mesh.quads);
}
