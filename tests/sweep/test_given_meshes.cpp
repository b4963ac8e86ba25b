// SPDX-License-Identifier: MIT
#include "given_skins.h"

using namespace lacuna;
using namespace lacuna::test;

TEST_CASE("given quads of source, target and walls are faces of the mesh, bit for bit, in every class")
{
    struct Map {
        const char* name;
        Vec3 (*map)(const Vec3&);
    };
    const Map maps[] = {{"uneven", uneven}, {"twisted", twisted}, {"bent", bent}};
    int meshed = 0;
    for (const Map& map : maps) {
        for (const Missing& missing_faces : kMissing) {
            for (const int columns : {2, 5}) {
                const test::BlockOptions plain{.columns = columns, .rows = 4, .layers = 6};
                test::BlockOptions moved = plain;
                moved.map = map.map;
                const GivenSkin before = skin_of(test::block(plain)), skin = skin_of(test::block(moved));
                std::size_t next = 0;
                Opened opened = open(skin, [&](int part, const Vec3&) {
                    Vec3 centre = Vec3::Zero();
                    for (const Index n : before.quads[next])
                        centre += before.nodes[static_cast<std::size_t>(n)] / 4;
                    ++next;
                    return missing_faces.gone(part, centre) ? Given::no : Given::quads;
                });
                CAPTURE(map.name);
                CAPTURE(missing_faces.value);
                CAPTURE(columns);
                CHECK(to_string(classify(opened.volume).value) == missing_faces.value);
                SweepOptions options;
                options.layers.count = std::string(missing_faces.value) == "I" ? 6 : 0;
                const Swept result = filled(opened.volume, options);
                test::check_valid(result.mesh);
                CHECK(result.mesh.layers == 6);
                CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
                ++meshed;
            }
        }
    }
    MESSAGE(meshed << " blocks, every given quad kept");
}

TEST_CASE("ends of the same graph are kept both, however their points and quads are numbered")
{
    int meshed = 0;
    for (Vec3 (*map)(const Vec3&) : {uneven, twisted, bent}) {
        for (const char* value : {"I", "II", "III"}) {
            const auto missing_faces = std::find_if(kMissing.begin(), kMissing.end(), [&](const Missing& m) {
                return std::string(m.value) == value;
            });
            for (unsigned seed = 1; seed < 6; ++seed) {
                CAPTURE(value);
                CAPTURE(seed);
                // An outline with a bay, so that the quads' graph is no plain grid.
                const auto bay = [](int column, int row) { return row == 0 && column == 1; };
                const test::BlockOptions plain{.columns = 4, .rows = 5, .layers = 3, .leave_out = bay};
                test::BlockOptions moved = plain;
                moved.map = map;
                const GivenSkin before = shuffled(skin_of(test::block(plain)), seed);
                std::size_t next = 0;
                Opened opened = open(shuffled(skin_of(test::block(moved)), seed), [&](int part, const Vec3&) {
                    Vec3 centre = Vec3::Zero();
                    for (const Index n : before.quads[next])
                        centre += before.nodes[static_cast<std::size_t>(n)] / 4;
                    ++next;
                    return missing_faces->gone(part, centre) ? Given::no : Given::quads;
                });
                SweepOptions options;
                options.layers.count = 3;
                const Swept result = filled(opened.volume, options);
                test::check_valid(result.mesh);
                CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
                ++meshed;
            }
        }
    }
    MESSAGE(meshed << " blocks with a bay, every given quad kept");
}

TEST_CASE("a void in a ring of given quads keeps the rows on both of its walls")
{
    const GivenSkin skin = skin_of(test::ring(14, 5));
    for (const bool target : {false, true}) {
        Opened opened = open(skin, [&](int part, const Vec3&) {
            return part == 2 || (part == 1 && target) ? Given::quads : Given::no;
        });
        const Swept result = filled(opened.volume, {});
        test::check_valid(result.mesh);
        CHECK(result.mesh.layers == 5);
        CHECK(kept(result.mesh, opened.quads) == opened.quads.size());
    }
}

TEST_CASE("nodes on the rims of given triangles are nodes of the mesh, on walls too")
{
    for (const Missing& missing_faces : kMissing) {
        const test::BlockOptions plain{.columns = 3, .rows = 4, .layers = 5};
        test::BlockOptions moved = plain;
        moved.map = uneven;
        const GivenSkin before = skin_of(test::block(plain)), skin = skin_of(test::block(moved));
        std::size_t next = 0;
        std::vector<Vec3> rim;
        Opened opened = open(skin, [&](int part, const Vec3&) {
            const std::size_t i = next++;
            Vec3 centre = Vec3::Zero();
            for (const Index n : before.quads[i]) centre += before.nodes[static_cast<std::size_t>(n)] / 4;
            if (missing_faces.gone(part, centre)) return Given::no;
            for (const Index n : before.quads[i]) {
                const Vec3& p = before.nodes[static_cast<std::size_t>(n)];
                const auto at_end = [](double x) { return x < 1e-9 || x > 1 - 1e-9; };
                const int ends = int(at_end(p.x())) + int(at_end(p.y())) + int(at_end(p.z()));
                if (ends > 1) rim.push_back(skin.nodes[static_cast<std::size_t>(n)]);
            }
            return Given::triangles;
        });
        CAPTURE(missing_faces.value);
        SweepOptions options;
        options.layers.count = 5;
        options.size = [](const Vec3&) { return 0.6; };
        const Swept result = filled(opened.volume, options);
        test::check_valid(result.mesh);
        CHECK(missing(result.mesh, rim) == 0);
    }
}

TEST_CASE("walls of other rows than the layers asked for are refused with both counts")
{
    const GivenSkin skin = skin_of(test::block({.columns = 3, .rows = 4, .layers = 5}));
    Opened opened = open(skin, [](int part, const Vec3&) { return part == 1 ? Given::no : Given::quads; });
    SweepOptions options;
    options.layers.count = 7;
    CHECK(test::refusal([&] { filled(opened.volume, options); }, {"5 rows", "7 layers"}) ==
          "sweep.given_rows");
}

TEST_CASE("walls that were meshed with different rows are refused by name, with both counts")
{
    const GivenSkin five = skin_of(test::block({.columns = 4, .rows = 4, .layers = 5}));
    const GivenSkin three = skin_of(test::block({.columns = 4, .rows = 4, .layers = 3}));
    GivenSkin both{five.nodes, {}, {}};
    const auto offset = static_cast<Index>(five.nodes.size());
    both.nodes.insert(both.nodes.end(), three.nodes.begin(), three.nodes.end());
    const auto add = [&](const GivenSkin& skin, Index shift,
                         const std::function<bool(int, const Vec3&)>& take) {
        for (std::size_t i = 0; i < skin.quads.size(); ++i) {
            Vec3 centre = Vec3::Zero();
            Quad quad = skin.quads[i];
            for (Index& n : quad) {
                centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
                n += shift;
            }
            if (!take(skin.part[i], centre)) continue;
            both.quads.push_back(quad);
            both.part.push_back(skin.part[i]);
        }
    };
    add(five, 0, [](int part, const Vec3& p) { return part < 2 || on_side(part, p, 0); });
    add(three, offset, [](int part, const Vec3& p) { return on_side(part, p, 2); });
    Opened opened = open(both, [](int, const Vec3&) { return Given::quads; });
    CHECK(test::refusal([&] { filled(opened.volume, {}); }, {" 5", " 3", "rows of quads"}) ==
          "surface.wall_rows");
}

TEST_CASE("given wall quads that are no rows are refused, the first of them named by its place")
{
    // A quad of the wall is cut into five: the four round it are in no row.
    GivenSkin skin = skin_of(test::block({.columns = 3, .rows = 3, .layers = 3}));
    std::size_t cut = 0;
    for (std::size_t i = 0; i < skin.quads.size(); ++i) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : skin.quads[i]) centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
        if (skin.part[i] == 2 && (centre - Vec3(0.5, 0, 0.5)).norm() < 1e-9) cut = i;
    }
    const Quad outer = skin.quads[cut];
    Vec3 middle = Vec3::Zero();
    for (const Index n : outer) middle += skin.nodes[static_cast<std::size_t>(n)] / 4;
    Quad inner{};
    for (std::size_t k = 0; k < 4; ++k) {
        inner[k] = static_cast<Index>(skin.nodes.size());
        skin.nodes.push_back((middle + skin.nodes[static_cast<std::size_t>(outer[k])]) / 2);
    }
    skin.quads[cut] = inner;
    for (std::size_t k = 0; k < 4; ++k) {
        skin.quads.push_back({outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]});
        skin.part.push_back(2);
    }
    Opened opened = open(skin, [](int part, const Vec3&) { return part == 1 ? Given::no : Given::quads; });
    CHECK(test::refusal([&] { filled(opened.volume, {}); }, {"rows", "wall"}) == "surface.wall_not_rows");
}

TEST_CASE("a rim with an odd number of given sides is filled, and the side that is divided is said")
{
    const GivenSkin skin = skin_of(test::ring(9, 4));
    Opened opened = open(skin, [](int part, const Vec3& p) {
        return part == 2 && p.head<2>().norm() > 1.4 ? Given::quads : Given::no;
    });
    const Swept result = filled(opened.volume, {});
    test::check_valid(result.mesh);
    CHECK(kept(result.mesh, opened.quads) + 4 == opened.quads.size());
    CHECK(missing(result.mesh, opened.nodes) == 0);
    CHECK(std::any_of(result.report.begin(), result.report.end(), [](const std::string& line) {
        return line.find("9 sides, an odd number") != std::string::npos;
    }));
}
