// SPDX-License-Identifier: MIT
#include "given_skins.h"
#include "support/whole_families.h"

#include <cstdint>

using namespace lacuna;
using namespace lacuna::test;

namespace {

/// Walls that cover only a part: which quads are left out, by their places before the hull is bent.
struct Partial {
    const char* name;
    std::function<bool(int side, const Vec3& before)> gone;
};

/// A hull that is taken apart: its mesh as it was made, and the side of each wall quad by its place there.
struct Hull {
    const char* name;
    mesh::HexMesh mesh;
    std::function<int(const Vec3&)> side;
    std::vector<Partial> partial;
};

int side_of(const Vec3& p)
{
    for (int side = 0; side < 4; ++side) {
        if (on_side(2, p, side)) return side;
    }
    return 4;
}

Hull block_hull()
{
    return {
        "block",
        test::block({.columns = 4, .rows = 5, .layers = 6}),
        side_of,
        {
            {"stubs of one height", [](int, const Vec3& p) { return p.z() > 0.5; }},
            {"stubs of two heights",
             [](int side, const Vec3& p) { return p.z() > (side % 2 == 0 ? 0.34 : 0.67); }},
            {"stubs of four heights", [](int side, const Vec3& p) { return p.z() > 0.2 + 0.17 * side; }},
            {"one stub, else void", [](int side, const Vec3& p) { return side != 0 || p.z() > 0.5; }},
            {"one stub, else whole", [](int side, const Vec3& p) { return side == 0 && p.z() > 0.5; }},
            {"one stub, two void",
             [](int side, const Vec3& p) { return (side == 0 && p.z() > 0.5) || side == 1 || side == 2; }},
            {"stubs from the target", [](int, const Vec3& p) { return p.z() < 0.5; }},
            {"stubs from both", [](int, const Vec3& p) { return p.z() > 0.34 && p.z() < 0.67; }},
            {"stubs in turn",
             [](int side, const Vec3& p) { return side % 2 == 0 ? p.z() > 0.5 : p.z() < 0.34; }},
            {"half a wall wide",
             [](int side, const Vec3& p) { return side == 0 && p.z() > 0.5 && p.x() > 0.5; }},
            {"half a wall wide, whole height",
             [](int side, const Vec3& p) { return side == 0 && p.x() > 0.5; }},
            {"half of all walls",
             [](int side, const Vec3& p) { return side % 2 == 0 ? p.x() > 0.5 : p.y() > 0.5; }},
            {"half of all walls, and half as high",
             [](int side, const Vec3& p) {
                 return (side % 2 == 0 ? p.x() > 0.5 : p.y() > 0.5) || p.z() > 0.5;
             }},
            {"a recess",
             [](int side, const Vec3& p) {
                 return side == 0 && p.z() > 0.5 && p.x() > 0.25 && p.x() < 0.75;
             }},
            {"a tongue",
             [](int side, const Vec3& p) {
                 return side == 0 && p.z() > 0.5 && (p.x() > 0.75 || p.x() < 0.25);
             }},
            {"a tongue, else void",
             [](int side, const Vec3& p) {
                 return !(side == 0 && p.z() < 0.5 && p.x() < 0.75 && p.x() > 0.25);
             }},
            {"a stair", [](int side, const Vec3& p) { return side == 0 && p.z() > 0.3 + 0.5 * p.x(); }},
            {"stairs all round",
             [](int side, const Vec3& p) { return p.z() > 0.3 + 0.5 * (side % 2 == 0 ? p.x() : p.y()); }},
            {"a window",
             [](int side, const Vec3& p) { return side == 0 && (p - Vec3(0.5, 0, 0.5)).norm() < 0.25; }},
        }};
}

Hull bay_hull()
{
    const auto bay = [](int column, int row) { return row == 0 && column == 1; };
    return {"bay",
            test::block({.columns = 4, .rows = 5, .layers = 6, .leave_out = bay}),
            side_of,
            {
                {"stubs of one height", [](int, const Vec3& p) { return p.z() > 0.5; }},
                {"a stub in the bay", [](int side, const Vec3& p) { return side == 4 && p.z() > 0.5; }},
                {"whole in the bay", [](int side, const Vec3& p) { return side != 4 && p.z() > 0.5; }},
                {"only the bay", [](int side, const Vec3&) { return side != 4; }},
                {"only a stub in the bay", [](int side, const Vec3& p) { return side != 4 || p.z() > 0.5; }},
                {"stubs of five heights", [](int side, const Vec3& p) { return p.z() > 0.2 + 0.17 * side; }},
            }};
}

Hull ring_hull(int around)
{
    const auto wall = [](const Vec3& p) { return p.head<2>().norm() > 1.5 ? 1 : 0; };
    return {
        "ring",
        test::ring(around, 6),
        wall,
        {
            {"both walls half", [](int, const Vec3& p) { return p.z() > 0.5; }},
            {"outer half", [](int side, const Vec3& p) { return side == 1 && p.z() > 0.5; }},
            {"inner half, outer void", [](int side, const Vec3& p) { return side == 1 || p.z() > 0.5; }},
            {"other heights", [](int side, const Vec3& p) { return p.z() > (side == 1 ? 0.34 : 0.67); }},
            {"against each other",
             [](int side, const Vec3& p) { return side == 1 ? p.z() < 0.5 : p.z() > 0.5; }},
            {"from both ends", [](int, const Vec3& p) { return p.z() > 0.34 && p.z() < 0.67; }},
            {"half of the outer",
             [](int side, const Vec3& p) { return side == 1 && p.z() > 0.5 && p.x() > 0; }},
            {"half of the outer, whole height",
             [](int side, const Vec3& p) { return side == 1 && p.x() > 0; }},
            {"stairs", [](int side, const Vec3& p) { return side == 1 && p.z() > 0.5 + 0.15 * p.x(); }},
            {"a window",
             [](int side, const Vec3& p) { return side == 1 && p.x() > 1.4 && std::abs(p.z() - 0.5) < 0.2; }},
        }};
}

/// A number from -1 to 1 by place and seed: the same for the same place.
double noise(const Vec3& p, unsigned seed)
{
    std::uint64_t h = 1469598103934665603ULL + seed;
    for (const double x : p)
        h = (h ^ static_cast<std::uint64_t>(std::llround(x * 4096) + 77777)) * 1099511628211ULL;
    h ^= h >> 29;
    h *= 0xbf58476d1ce4e5b9ULL;
    h ^= h >> 32;
    return static_cast<double>(h % 2001) / 1000.0 - 1;
}

Vec3 jittered(const Vec3& p) { return uneven(p + 0.02 * Vec3(noise(p, 1), noise(p, 2), noise(p, 3))); }

/// Rows of other heights in each column.
Vec3 jittered_rows(const Vec3& p)
{
    const bool inside = p.z() > 1e-9 && p.z() < 1 - 1e-9;
    return inside ? Vec3(p.x(), p.y(), p.z() + 0.05 * noise(p, 4)) : p;
}

struct Map {
    const char* name;
    Vec3 (*map)(const Vec3&);
};
const Map kMaps[] = {{"plain", [](const Vec3& p) { return p; }},
                     {"uneven", uneven},
                     {"twisted", twisted},
                     {"bent", bent},
                     {"jittered", jittered},
                     {"jittered rows", jittered_rows}};

/// How the ends of a hull come.
struct Ends {
    const char* name;
    Given source, target;
};
const Ends kEnds[] = {{"quads", Given::quads, Given::quads},
                      {"triangles", Given::triangles, Given::triangles},
                      {"source alone", Given::quads, Given::no},
                      {"target alone", Given::no, Given::quads},
                      {"none", Given::no, Given::no}};

/// A hull with parts of its walls left out, bent.
Opened opened(const Hull& hull, const Partial& partial, const Map& map, const Ends& ends)
{
    const GivenSkin before = skin_of(hull.mesh);
    GivenSkin skin = before;
    for (Vec3& p : skin.nodes) {
        // What bends a block bends a ring of its size.
        if (std::string(hull.name) == "ring") p.head<2>() = p.head<2>() / 4 + Eigen::Vector2d(0.5, 0.5);
        p = map.map(p);
    }
    std::size_t next = 0;
    return open(skin, [&](int part, const Vec3&) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : before.quads[next]) centre += before.nodes[static_cast<std::size_t>(n)] / 4;
        ++next;
        if (part == 0) return ends.source;
        if (part == 1) return ends.target;
        return partial.gone(hull.side(centre), centre) ? Given::no : Given::quads;
    });
}

struct Tally {
    int meshed = 0, refused = 0;
};

/// Mesh a hull: all given quads are faces of the mesh, or an error says by name why not.
void fill(const Hull& hull, const Partial& partial, const Map& map, const Ends& ends, Tally& tally)
{
    CAPTURE(std::string(hull.name));
    CAPTURE(std::string(partial.name));
    CAPTURE(std::string(map.name));
    CAPTURE(std::string(ends.name));
    try {
        Opened parts = opened(hull, partial, map, ends);
        const Swept result = filled(parts.volume, {});
        test::check_valid(result.mesh);
        CHECK(kept(result.mesh, parts.quads) == parts.quads.size());
        ++tally.meshed;
    } catch (const Error& error) {
        const std::string text = error.what();
        const bool names = text.find("face ") != std::string::npos ||
                           text.find("faces ") != std::string::npos ||
                           text.find("edge ") != std::string::npos ||
                           text.find("cells") != std::string::npos || text.find("loops") != std::string::npos;
        CAPTURE(text);
        CHECK(names);
        ++tally.refused;
    }
}

} // namespace

TEST_CASE("walls that cover a part of the height or the width keep their quads, bit for bit")
{
    Tally blocks, rings, one_end;
    test::MembersToRun run(5); // a fifth, each part, map and way that ends come among them
    for (const Hull& hull : {block_hull(), bay_hull(), ring_hull(14)}) {
        for (const Partial& partial : hull.partial) {
            for (const Map& map : kMaps) {
                for (const Ends& ends : kEnds) {
                    const bool both = ends.source != Given::no && ends.target != Given::no;
                    const bool round = std::string(hull.name) == "ring";
                    // Without both ends the walls' open rims are the other's.
                    if (!both && map.map != bent) continue;
                    // Rims of triangles are kept in the same way as those of quads.
                    if (ends.source == Given::triangles && map.map != bent && map.map != uneven) continue;
                    if (!run.next()) continue;
                    fill(hull, partial, map, ends, !both ? one_end : round ? rings : blocks);
                }
            }
        }
    }
    MESSAGE(blocks.meshed << " blocks between two ends, " << blocks.refused << " refused");
    MESSAGE(rings.meshed << " rings between two ends, " << rings.refused << " refused");
    MESSAGE(one_end.meshed << " of walls that end at one height, " << one_end.refused
                           << " of others refused");
    CHECK(blocks.refused * 20 < blocks.meshed);
    CHECK(rings.refused * 3 < rings.meshed);
}

TEST_CASE("above a wall that ends half way are as many layers as the whole walls beside it have, or as asked")
{
    const Hull hull = block_hull();
    const auto of = [&](const char* name) {
        return *std::find_if(hull.partial.begin(), hull.partial.end(),
                             [&](const Partial& p) { return std::string(p.name) == name; });
    };
    const Ends both{"quads", Given::quads, Given::quads};
    Opened beside = opened(hull, of("one stub, else whole"), kMaps[0], both);
    CHECK(filled(beside.volume, {}).mesh.layers == 6);
    for (const int layers : {4, 5, 11}) {
        Opened alone = opened(hull, of("stubs of one height"), kMaps[0], both);
        SweepOptions options;
        options.layers.count = layers;
        const Swept result = filled(alone.volume, options);
        CHECK(result.mesh.layers == layers);
        CHECK(kept(result.mesh, alone.quads) == alone.quads.size());
        // The report counts the nodes of each face.
        CHECK(std::any_of(result.report.begin(), result.report.end(), [](const std::string& line) {
            return line.find("20 of 20 nodes coincide") != std::string::npos;
        }));
    }
    Opened alone = opened(hull, of("stubs of one height"), kMaps[0], both);
    SweepOptions options;
    options.layers.count = 3;
    CHECK(test::refusal([&] { filled(alone.volume, options); }, {"wall", " 3", "3 layers", "4 or more"}) ==
          "surface.stub_rows");
}

TEST_CASE("a wall of as many rows as the whole walls that ends before the target is refused with both counts")
{
    // The wall y = 0 is half as high with as many rows.
    const Hull hull = block_hull();
    GivenSkin skin = skin_of(hull.mesh);
    std::vector<Index> copy(skin.nodes.size(), -1);
    for (std::size_t i = 0; i < skin.quads.size(); ++i) {
        Vec3 centre = Vec3::Zero();
        for (const Index n : skin.quads[i]) centre += skin.nodes[static_cast<std::size_t>(n)] / 4;
        if (skin.part[i] != 2 || side_of(centre) != 0 || centre.x() < 0.25 || centre.x() > 0.75) continue;
        for (Index& n : skin.quads[i]) {
            const Vec3 p = skin.nodes[static_cast<std::size_t>(n)];
            if (p.z() < 1e-9) continue;
            Index& moved = copy[static_cast<std::size_t>(n)];
            if (moved < 0) {
                moved = static_cast<Index>(skin.nodes.size());
                skin.nodes.emplace_back(p.x(), p.y(), p.z() / 2);
            }
            n = moved;
        }
    }
    copy.resize(skin.nodes.size(), -1);
    Opened parts = open(skin, [](int part, const Vec3& p) {
        const bool beside = part == 2 && side_of(p) == 0 && (p.x() < 0.25 || p.x() > 0.75);
        return beside ? Given::no : Given::quads;
    });
    CHECK(test::refusal([&] { filled(parts.volume, {}); },
                        {"wall", " 6 rows of given quads", "has 6 rows"}) == "surface.wall_rows");
}
