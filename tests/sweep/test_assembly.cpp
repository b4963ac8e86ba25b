// SPDX-License-Identifier: MIT
#include "support/assemblies.h"
#include "support/check_valid.h"
#include "support/dice.h"
#include "support/refusal.h"
#include "support/volumes.h"
#include "support/whole_families.h"

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/geometry/shared/triangulate.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/topology/shared/give_mesh.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::AssemblyMember;
using sweep::SweptAssembly;

using test::Brick;
using test::brick;
using test::check_assembly;
using test::closed;
using test::inner_quads;
using test::Members;

TEST_CASE("two volumes end to end have one mesh where they meet, however their faces are faceted")
{
    for (const int cuts : {1, 3}) {
        Members members;
        members.add(brick({.low = {0, 0, 0}, .high = {2, 1, 1}, .cuts = cuts}), 0.25);
        members.add(brick({.low = {0, 0, 1}, .high = {2, 1, 3}, .cuts = 2}), 0.4);
        const SweptAssembly whole = sweep::sweep_assembly(members.list());
        check_assembly(whole, 6);
        CHECK(whole.shared.size() == 1);
        CHECK(inner_quads(whole) == 32);
    }
}

TEST_CASE("volumes side by side get the same layers, and a wall that is another's end goes first")
{
    Members members;
    members.add(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), 0.5);
    members.add(brick({.low = {1, 0, 0}, .high = {2, 1, 1}}), 0.2);
    members.add(brick({.low = {2, 0, 0}, .high = {4, 1, 1}, .axis = 0}), 0.3);
    const SweptAssembly whole = sweep::sweep_assembly(members.list());
    check_assembly(whole, 4);
    CHECK(whole.parts[0].mesh.layers == 5);
    CHECK(whole.parts[1].mesh.layers == 5);
    CHECK(inner_quads(whole) > 0);
}

TEST_CASE("other numbers of layers asked for in volumes side by side are refused by name")
{
    Members members;
    members.add(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), 0.5, 3);
    members.add(brick({.low = {1, 0, 0}, .high = {2, 1, 1}}), 0.2, 4);
    CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); }, {"part_1", "part_2", "3 and 4"}) ==
          "assembly.layers");
}

TEST_CASE("volumes that overlap are refused by name")
{
    Members twice;
    twice.add(brick({.low = {0, 0, 0}, .high = {2, 1, 1}}), 0.5);
    twice.add(brick({.low = {0, 0, 0}, .high = {2, 1, 1}}), 0.5);
    CHECK(test::refusal([&] { sweep::sweep_assembly(twice.list()); }, {"same side"}) == "assembly.overlap");
}

TEST_CASE("volumes that share part of a face are one mesh: both faces are split along the other's rim")
{
    struct Case {
        const char* name;
        Vec3 low, high;
        int axis;
        double volume;
    };
    // Beside or on a block of 3 × 2 × 1.
    for (const Case& c : {Case{"half of the top", {0, 0, 1}, {1.5, 2, 2}, 2, 9},
                          {"within the top", {1, 0.5, 1}, {2, 1.5, 2}, 2, 7},
                          {"over a corner", {2, 1, 1}, {4, 3, 2}, 2, 10},
                          {"over an edge", {1, -1, 1}, {2, 1, 2}, 2, 8},
                          {"across", {1, -1, 1}, {2, 3, 2}, 2, 10},
                          {"half of a side", {3, 0, 0}, {4, 1, 1}, 2, 7},
                          {"higher at a side", {3, 0, 0}, {4, 2, 2}, 2, 10},
                          {"on its side, swept across", {1, 0.5, 1}, {2, 1.5, 2}, 0, 7}}) {
        for (const int cuts : {1, 3}) {
            CAPTURE(c.name);
            CAPTURE(cuts);
            Members members;
            members.add(brick({.low = {0, 0, 0}, .high = {3, 2, 1}, .cuts = cuts}), 0.5);
            members.add(brick({.low = c.low, .high = c.high, .axis = c.axis, .cuts = 2}), 0.4);
            try {
                const SweptAssembly whole = sweep::sweep_assembly(members.list());
                check_assembly(whole, c.volume);
                CHECK(whole.shared.size() >= 1);
                CHECK(inner_quads(whole) > 0);
            } catch (const Error& error) {
                FAIL_CHECK(error.what());
            }
        }
    }
}

namespace {

/// A core of a height, the ring round it, and a plug on the core.
Members core_ring_plug(double size)
{
    Members members;
    test::PrismOptions core{.sides = 0, .radius = 1, .height = 2, .cuts = 4};
    test::PrismOptions ring{.sides = 0, .radius = 2, .height = 2, .cuts = 4};
    ring.hole_list = {{{0, 0}, 1}};
    members.add(closed(test::prism(core).open()), size);
    members.add(closed(test::prism(ring).open()), size);
    test::PrismOptions plug = core;
    plug.height = 1;
    test::Prism on_top = test::prism(plug);
    on_top.model = test::moved(on_top.model, [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 2)); });
    members.add(closed(on_top.open()), size);
    return members;
}

/// Middle nodes of shared quads are one node too: as many as the quads have sides and, of hex27, middles.
void check_middles(const SweptAssembly& whole, bool full)
{
    std::vector<std::set<Index>> skin(whole.parts.size());
    for (std::size_t p = 0; p < whole.parts.size(); ++p) {
        const mesh::HexMesh& mesh = whole.parts[p].mesh;
        REQUIRE(whole.numbering[p].fresh() + whole.numbering[p].known().size() == mesh.node_count());
        for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
            for (const Index n : mesh::skin_nodes(mesh, i))
                skin[p].insert(whole.numbering[p].of(n));
        }
    }
    for (const sweep::SharedFace& face : whole.shared) {
        const mesh::HexMesh& mesh = whole.parts[face.a].mesh;
        std::size_t quads = 0;
        std::set<Index> nodes;
        for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
            const Index patch = mesh::skin_quad(mesh, i).patch;
            if (whole.parts[face.a].faces[static_cast<std::size_t>(patch)] != face.face_a) continue;
            ++quads;
            const mesh::CellNodes all = mesh::skin_nodes(mesh, i);
            CHECK(all.count == (full ? 9 : 8));
            for (const Index n : all.all()) nodes.insert(whole.numbering[face.a].of(n));
        }
        CHECK(quads > 0);
        for (const Index n : nodes) CHECK(skin[face.b].contains(n));
    }
}

} // namespace

TEST_CASE("a core, the ring round it and a plug on the core are one mesh")
{
    Members members = core_ring_plug(0.35);
    members.options[1].size = [](const Vec3&) { return 0.5; };
    const SweptAssembly whole = sweep::sweep_assembly(members.list());
    double sealed = 0;
    for (const auto& p : whole.parts) sealed += p.fidelity.sealed_volume;
    check_assembly(whole, sealed, 0.05);
    CHECK(whole.shared.size() == 2);
}

TEST_CASE("round volumes of an assembly lose as little of their volume as alone")
{
    for (const double size : {0.6, 1.0}) {
        CAPTURE(size);
        Members members = core_ring_plug(size);
        const SweptAssembly whole = sweep::sweep_assembly(members.list());
        for (std::size_t m = 0; m < whole.parts.size(); ++m) {
            const sweep::Swept alone = sweep::sweep(members.volumes[m], members.options[m]);
            const auto lost = [](const sweep::Fidelity& f) { return 1 - f.volume / f.sealed_volume; };
            CHECK(lost(alone.fidelity) <= members.options[m].volume_share);
            CHECK(lost(whole.parts[m].fidelity) <= members.options[m].volume_share);
        }
        // Who names the sides for a turn gets those.
        for (sweep::SweepOptions& options : members.options) options.volume_share = 0;
        const SweptAssembly asked = sweep::sweep_assembly(members.list());
        CHECK(asked.nodes < whole.nodes);
    }
}

TEST_CASE("slices of a pie, swept along the edge that they share, are one disc")
{
    for (const int slices : {2, 3, 5, 8}) {
        CAPTURE(slices);
        Members members;
        double volume = 0;
        for (int s = 0; s < slices; ++s) {
            std::vector<Vec2> outline{{0, 0}};
            constexpr int kChords = 4;
            for (int i = 0; i <= kChords; ++i) {
                const double a = 2 * std::numbers::pi * (s + static_cast<double>(i) / kChords) / slices;
                outline.emplace_back(std::cos(a), std::sin(a));
            }
            test::PrismOptions slice{.height = 1, .outline = outline};
            const int gone = s % 2 == 0 ? 0 : kChords + 1; // one of the cuts, which a neighbour has
            slice.drop = [=](const test::Part& part) {
                return slices > 2 && part.role == Role::wall && part.side == gone;
            };
            const test::Prism made = test::prism(slice);
            volume += made.facet_volume;
            members.add(closed(made.open()), 0.3);
        }
        const SweptAssembly whole = sweep::sweep_assembly(members.list());
        check_assembly(whole, volume, 1e-6);
        CHECK(whole.shared.size() == static_cast<std::size_t>(slices));
    }
}

TEST_CASE("volumes of an assembly at order 2 share middle nodes, on flat faces and round ones")
{
    for (const bool serendipity : {false, true}) {
        CAPTURE(serendipity);
        Members members = core_ring_plug(0.5);
        Members blocks;
        blocks.add(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), 0.5);
        blocks.add(brick({.low = {1, 0, 0}, .high = {2, 1, 1}, .axis = 0}), 0.3);
        blocks.add(brick({.low = {1, 1, 0}, .high = {2, 2, 1}, .axis = 1}), 0.3);
        for (Members* each : {&members, &blocks}) {
            for (sweep::SweepOptions& options : each->options) {
                options.order = 2;
                options.second_order.serendipity = serendipity;
            }
            const SweptAssembly whole = sweep::sweep_assembly(each->list());
            check_middles(whole, !serendipity);
            for (const sweep::Swept& part : whole.parts) {
                test::check_valid(part.mesh);
                CHECK(quality::measure(part.mesh).uncertified == 0);
                CHECK(part.fidelity.volume == doctest::Approx(part.fidelity.sealed_volume).epsilon(0.01));
            }
        }
        members.options[1].order = 1;
        members.options[1].second_order.serendipity = false;
        CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); }, {"part_1", "part_2", "order"}) ==
              "assembly.order");
    }
}

TEST_CASE("wedges of one volume's end are the end of the next, with hexahedra beside them")
{
    for (const bool below : {false, true}) {
        CAPTURE(below);
        Members members;
        members.add(brick({.low = {0, 0, 0}, .high = {2, 2, 1}}), 1);
        members.add(brick({.low = {0, 0, 1}, .high = {2, 2, 2}}), 1);
        members.add(brick({.low = {2, 0, 0}, .high = {3, 2, 1}}), 1);
        for (sweep::SweepOptions& options : members.options) options.wedges = true;
        // Four quads, one of them as two triangles, on the far end of the first or the second.
        OpenVolume& first = members.volumes[below ? 0 : 1];
        const FaceId end = first.faces(below ? Role::source : Role::target).front();
        std::vector<Vec3> nodes;
        for (int j = 0; j < 3; ++j)
            for (int i = 0; i < 3; ++i) nodes.emplace_back(i, j, below ? 0 : 2);
        const std::vector<Quad> cells{{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 8}, {4, 8, 7, 7}};
        topology::give_mesh(first, end, nodes, cells);
        const SweptAssembly whole = sweep::sweep_assembly(members.list());
        check_assembly(whole, 10);
        CHECK(whole.parts[0].mesh.wedge_count() == 2 * static_cast<std::size_t>(whole.parts[0].mesh.layers));
        CHECK(whole.parts[1].mesh.wedge_count() == 2 * static_cast<std::size_t>(whole.parts[1].mesh.layers));
        CHECK(whole.parts[2].mesh.wedge_count() == 0);
        CHECK(whole.shared.size() == 2);
    }
}

TEST_CASE("round volumes near each other are apart, and a thin one between two is one mesh with both")
{
    for (const double gap : {0.5, 0.2, 0.05, 0.01}) {
        CAPTURE(gap);
        const auto disc = [](double low, double height) {
            test::Prism prism = test::prism({.sides = 0, .radius = 2, .height = height, .cuts = 5});
            prism.model = test::moved(prism.model,
                                      [low](const Vec3& p) { return Vec3(p + Vec3(0, 0, low)); });
            return closed(prism.open());
        };
        Members apart;
        apart.add(disc(0, 1), 0.6, 2);
        apart.add(disc(1 + gap, 1), 0.6, 2);
        const SweptAssembly two = sweep::sweep_assembly(apart.list());
        CHECK(two.shared.empty());
        CHECK(two.nodes == two.parts[0].mesh.nodes.size() + two.parts[1].mesh.nodes.size());
        Members gasket;
        gasket.add(disc(0, 1), 0.6, 2);
        gasket.add(disc(1, gap), 0.6, 1);
        gasket.add(disc(1 + gap, 1), 0.6, 2);
        const SweptAssembly three = sweep::sweep_assembly(gasket.list());
        CHECK(three.shared.size() == 2);
        double sealed = 0;
        for (const auto& p : three.parts) sealed += p.fidelity.sealed_volume;
        check_assembly(three, sealed, 0.05);
    }
}

TEST_CASE("a volume within another is refused by name, wherever their faces are")
{
    Members members;
    members.add(brick({.low = {0, 0, 0}, .high = {3, 3, 3}}), 1);
    members.add(brick({.low = {1, 1, 1}, .high = {2, 2, 2}, .cuts = 2}), 1);
    CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); }, {"part_1", "part_2"}) ==
          "assembly.overlap");
}

TEST_CASE("more sides on shared edges than memory holds are refused at once")
{
    Members members;
    members.add(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), 1, 100'000'000);
    members.add(brick({.low = {1, 0, 0}, .high = {2, 1, 1}}), 1);
    CHECK(test::refusal([&] { sweep::sweep_assembly(members.list()); }, {"400000004"}) == "sweep.too_many");
}

namespace {

/// What became of a family.
struct Tally {
    int meshed = 0, refused = 0;
    std::size_t pieces = 0;
    test::Refusals why;

    /// @param make   the members and the volume they enclose, share by which theirs may be off.
    void take(unsigned seed, const Members& members, double volume, double share)
    {
        CAPTURE(seed);
        try {
            const SweptAssembly whole = sweep::sweep_assembly(members.list());
            check_assembly(whole, volume, share);
            for (const sweep::NearMiss& miss : whole.near_misses) FAIL_CHECK(miss.message.text());
            ++meshed;
            pieces += whole.parts.size();
        } catch (const Error& error) {
            ++refused;
            why.add(seed, error);
        }
    }
    void report() const
    {
        MESSAGE(meshed << " meshed in " << pieces << " pieces, " << refused << " refused:" << why.in_words());
    }
};

/// Blocks in a grid, each swept along an axis of its own or all along one, a wall of each missing.
void take_grid(unsigned seed, Tally& tally)
{
    test::Dice dice(seed);
    const std::array<int, 3> n{dice.whole(1, 3), dice.whole(1, 2), dice.whole(1, 3)};
    std::array<std::vector<double>, 3> lines;
    double volume = 1;
    for (std::size_t a = 0; a < 3; ++a) {
        double at = 0;
        for (int i = 0; i <= n[a]; ++i, at += dice.between(0.6, 1.6)) lines[a].push_back(at);
        volume *= lines[a].back() - lines[a].front();
    }
    const double twist = dice.between(-0.2, 0.2);
    const bool one_axis = dice.chance(0.5);
    Members members;
    for (int i = 0; i < n[0]; ++i)
        for (int j = 0; j < n[1]; ++j)
            for (int k = 0; k < n[2]; ++k) {
                Brick b;
                const std::array<int, 3> at{i, j, k};
                for (std::size_t a = 0; a < 3; ++a) {
                    b.low[static_cast<int>(a)] = lines[a][static_cast<std::size_t>(at[a])];
                    b.high[static_cast<int>(a)] = lines[a][static_cast<std::size_t>(at[a]) + 1];
                }
                b.axis = one_axis ? 2 : dice.whole(0, 2);
                b.cuts = dice.whole(1, 3);
                const int gone = dice.whole(0, 5);
                if (gone / 2 != b.axis) b.drop = [gone](int side) { return side == gone; };
                b.map = [twist](const Vec3& p) {
                    const double t = twist * p.z();
                    return Vec3(p.x() * std::cos(t) - p.y() * std::sin(t),
                                p.x() * std::sin(t) + p.y() * std::cos(t), p.z());
                };
                if (!one_axis) b.map = nullptr;
                if (b.map) b.cuts = 4;
                members.add(brick(b), dice.between(0.25, 0.5));
            }
    tally.take(seed, members, volume, one_axis ? 0.02 : 1e-9);
}

/// Cores and rings round each other, straight-sided or round, in courses of random heights on each other;
/// what is over another may be left out, and so may an outer wall.
void take_nest(unsigned seed, Tally& tally)
{
    test::Dice dice(1000 + seed);
    const int rings = dice.whole(1, 4), courses = dice.whole(1, 5);
    const int outer = dice.chance(0.4) ? 0 : dice.whole(3, 6); // sides of the outermost; all within are round
    Members members;
    double low = 0, volume = 0;
    for (int c = 0; c < courses; ++c) {
        const double height = dice.between(0.3, 1.5);
        for (int r = 0; r < rings; ++r) {
            if (c > 0 && rings > 1 && dice.chance(0.2)) continue;
            const double radius = r + 1 == rings && outer > 0 ? 1.5 * (r + 1) : 0.7 * (r + 1);
            test::PrismOptions options{
                .sides = r + 1 == rings ? outer : 0, .radius = radius, .height = height, .cuts = 4};
            if (r > 0) options.hole_list = {{{0, 0}, 0.7 * r}};
            if (outer > 0 && r + 1 == rings && dice.chance(0.5))
                options.drop = [](const test::Part& part) {
                    return part.role == Role::wall && part.loop == 0 && part.side == 1;
                };
            test::Prism made = test::prism(options);
            made.model = test::moved(made.model, [low](const Vec3& p) { return Vec3(p + Vec3(0, 0, low)); });
            volume += made.facet_volume;
            members.add(closed(made.open()), dice.between(0.3, 0.6));
        }
        low += height;
    }
    tally.take(seed, members, volume, 0.02);
}

/// Courses of bricks on each other, none divided where the one below is: parts of faces are shared.
void take_wall(unsigned seed, Tally& tally)
{
    test::Dice dice(2000 + seed);
    const int courses = dice.whole(1, 3);
    const double length = dice.between(2, 4), depth = dice.between(0.6, 1.2);
    const bool flat = dice.chance(0.5); // swept through the wall instead of up
    Members members;
    double low = 0, volume = 0;
    for (int c = 0; c < courses; ++c) {
        const double height = dice.between(0.5, 1.0);
        const int bricks = dice.whole(1, 4);
        double from = 0;
        for (int i = 0; i < bricks; ++i) {
            const double to = i + 1 == bricks ? length : length * (i + dice.between(0.8, 1.2)) / bricks;
            Brick b{.low = {from, 0, low}, .high = {to, depth, low + height}, .axis = flat ? 1 : 2};
            const int gone = dice.whole(0, 5);
            if (gone / 2 != b.axis) b.drop = [gone](int side) { return side == gone; };
            members.add(brick(b), dice.between(0.3, 0.5));
            volume += (to - from) * depth * height;
            from = to;
        }
        low += height;
    }
    tally.take(seed, members, volume, 1e-9);
}

/// A family's members, every so many of them.
Tally family(unsigned count, unsigned step, void (*take)(unsigned, Tally&))
{
    Tally tally;
    for (unsigned seed = 1; seed <= count; seed += step) take(seed, tally);
    tally.report();
    return tally;
}

} // namespace

TEST_CASE("grids of blocks, nests of cores and rings, and walls of bricks are one mesh or refused by name")
{
    const bool whole = test::whole_families();
    const unsigned step = whole ? 1 : 13; // 16 of 200, 7 of 80
    CHECK(family(200, step, take_grid).meshed >= (whole ? 198 : 15));
    CHECK(family(80, step, take_nest).meshed >= (whole ? 78 : 6));
    CHECK(family(80, step, take_wall).meshed >= (whole ? 72 : 6));
}

namespace {

/// Something that stands on the floor of a box.
struct Product {
    Vec2 centre;
    double radius, height;
    int sides;        ///< of its section; more than 12 count as round
    double tower = 0; ///< height of another, of half the radius, that stands on it; 0: none
};

/// The space in a box round and above what stands in it. Floor and tops are the source, the lid the target;
/// outer walls by number, 0 … 3, may be left out, and the lid may rise in the middle.
OpenVolume box_round(const Vec3& size, const std::vector<Product>& products, const std::vector<int>& gone,
                     double rise)
{
    healing::FacetSoup soup;
    std::vector<Role> role;
    const auto point = [&](const Vec3& p) {
        soup.points.push_back(p);
        return static_cast<Index>(soup.points.size()) - 1;
    };
    const auto label = [&](Role r, const std::string& name) {
        role.push_back(r);
        soup.label_name.push_back(name + "_" + std::to_string(role.size()));
        return static_cast<int>(role.size()) - 1;
    };
    const auto add = [&](const Triangle& t, int of) {
        soup.triangles.push_back(t);
        soup.triangle_label.push_back(of);
    };
    // A flat face between loops at a height, facing down.
    const auto plate = [&](const std::vector<std::vector<Vec2>>& loops, double z, int of) {
        std::vector<Vec2> flat;
        std::vector<std::vector<Index>> cycles;
        for (const std::vector<Vec2>& loop : loops) {
            cycles.emplace_back();
            for (const Vec2& p : loop) {
                cycles.back().push_back(static_cast<Index>(flat.size()));
                flat.push_back(p);
            }
        }
        geometry::TriangulateOptions options;
        options.interior_points = false;
        const geometry::Triangulation made = geometry::triangulate(flat, cycles, options);
        std::vector<Index> at;
        for (const Vec2& p : made.points) at.push_back(point({p.x(), p.y(), z}));
        for (const Triangle& t : made.triangles)
            add({at[static_cast<std::size_t>(t[0])], at[static_cast<std::size_t>(t[2])],
                 at[static_cast<std::size_t>(t[1])]},
                of);
    };
    const auto section = [](const Vec2& c, double r, int n) {
        std::vector<Vec2> loop;
        for (int i = 0; i < n; ++i) {
            const double a = 2 * std::numbers::pi * (i + 0.3) / n;
            loop.push_back(c + r * Vec2(std::cos(a), std::sin(a)));
        }
        return loop;
    };
    const auto skin = [&](const std::vector<Vec2>& loop, double low, double high) {
        const bool round = loop.size() > 12;
        int of = round ? label(Role::wall, "skin") : 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
            if (!round) of = label(Role::wall, "skin");
            const Index p = point({a.x(), a.y(), low}), q = point({b.x(), b.y(), low});
            const Index r = point({b.x(), b.y(), high}), s = point({a.x(), a.y(), high});
            add({p, r, q}, of);
            add({p, s, r}, of);
        }
    };
    const std::vector<Vec2> outer{{0, 0}, {size.x(), 0}, {size.x(), size.y()}, {0, size.y()}};
    std::vector<std::vector<Vec2>> floor{outer};
    for (const Product& p : products) floor.push_back(section(p.centre, p.radius, p.sides));
    plate(floor, 0, label(Role::source, "floor"));
    for (const Product& p : products) {
        const std::vector<Vec2> foot = section(p.centre, p.radius, p.sides);
        skin(foot, 0, p.height);
        if (p.tower > 0) {
            const std::vector<Vec2> upper = section(p.centre, p.radius / 2, p.sides);
            plate({foot, upper}, p.height, label(Role::source, "top"));
            skin(upper, p.height, p.height + p.tower);
            plate({upper}, p.height + p.tower, label(Role::source, "tower"));
        } else {
            plate({foot}, p.height, label(Role::source, "top"));
        }
    }
    constexpr int kCuts = 8;
    const auto lid = [&](int i, int j) {
        const double u = static_cast<double>(i) / kCuts, v = static_cast<double>(j) / kCuts;
        return point({u * size.x(), v * size.y(), size.z() + 16 * rise * u * (1 - u) * v * (1 - v)});
    };
    const int top = label(Role::target, "lid");
    for (int i = 0; i < kCuts; ++i) {
        for (int j = 0; j < kCuts; ++j) {
            const Index p = lid(i, j), q = lid(i + 1, j), r = lid(i + 1, j + 1), s = lid(i, j + 1);
            add({p, q, r}, top);
            add({p, r, s}, top);
        }
    }
    for (int k = 0; k < 4; ++k) {
        if (std::ranges::find(gone, k) != gone.end()) continue;
        const Vec2 a = outer[static_cast<std::size_t>(k)], b = outer[static_cast<std::size_t>((k + 1) % 4)];
        const int of = label(Role::wall, "side");
        const auto above = [&](int i, bool high) {
            const Vec2 p = a + (b - a) * i / kCuts;
            return point({p.x(), p.y(), high ? size.z() : 0});
        };
        const Index p = above(0, false), q = above(kCuts, false);
        // One facet below, as the floor has no points between its corners; a fan to those of the lid.
        for (int i = 0; i < kCuts; ++i) add({p, above(i + 1, true), above(i, true)}, of);
        add({p, q, above(kCuts, true)}, of);
    }
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        const auto of = static_cast<std::size_t>(std::stoi(name.substr(name.rfind('_') + 1))) - 1;
        (role[of] == Role::source   ? roles.source
         : role[of] == Role::target ? roles.target
                                    : roles.walls)
            .emplace_back(f);
    }
    return open_volume(model, roles);
}

double section_area(double radius, int sides)
{
    return sides / 2.0 * radius * radius * std::sin(2 * std::numbers::pi / sides);
}

} // namespace

TEST_CASE("what stands in a box gets room above it: pieces cut along the sweep, one mesh")
{
    int meshed = 0, refused = 0, pieces = 0;
    test::MembersToRun run(7); // nine of 60
    for (unsigned seed = 1; seed <= 60; ++seed) {
        if (!run.next()) continue;
        test::Dice dice(seed);
        const Vec3 size(dice.between(5, 7), dice.between(3, 4), dice.between(2.5, 4));
        std::vector<Product> products;
        const int count = dice.whole(1, 3);
        double volume = size.x() * size.y() * size.z();
        for (int p = 0; p < count; ++p) {
            Product product;
            product.centre = {size.x() * (p + 0.5) / count, size.y() / 2};
            product.radius = dice.between(0.5, 0.8);
            product.height = dice.between(0.8, 1.6);
            product.sides = dice.chance(0.5) ? dice.whole(3, 8) : 24;
            if (product.radius > 0.6 && dice.chance(0.3)) product.tower = 0.6;
            volume -= section_area(product.radius, product.sides) * product.height;
            volume -= section_area(product.radius / 2, product.sides) * product.tower;
            products.push_back(product);
        }
        std::vector<int> gone;
        if (dice.chance(0.5)) gone.push_back(dice.whole(0, 3));
        const double rise = dice.chance(0.3) && gone.empty() ? 0.4 : 0;
        volume += 16 * rise * size.x() * size.y() / 36;
        CAPTURE(seed);
        try {
            const std::vector<closure::StepPiece> cut = closure::cut_steps(
                box_round(size, products, gone, rise));
            std::size_t towers = 0;
            for (const Product& p : products) towers += p.tower > 0 ? 1 : 0;
            CHECK(cut.size() == 1 + products.size() + towers);
            Members members;
            for (const closure::StepPiece& piece : cut)
                members.add(closed(piece.volume), 0.3, piece.level == 0 ? 10 : 0);
            const SweptAssembly whole = sweep::sweep_assembly(members.list());
            check_assembly(whole, volume, 0.02);
            ++meshed;
            pieces += static_cast<int>(cut.size());
        } catch (const Error& error) {
            ++refused;
            MESSAGE(std::string(std::to_string(seed) + ": " + error.what()));
        }
    }
    MESSAGE(meshed << " meshed in " << pieces << " pieces, " << refused << " refused");
    CHECK(meshed >= (test::whole_families() ? 57 : 8));
}

namespace {

/// Tubes on each other that get wider, with ledges between them, as a mesh of triangles whose rims stay.
OpenVolume stepped_bore(int around, const std::vector<double>& radii, double height)
{
    healing::FacetSoup soup;
    const auto label = [&](const std::string& name) {
        soup.label_name.push_back(name);
        return static_cast<int>(soup.label_name.size()) - 1;
    };
    const auto ring = [&](double radius, double z) {
        const auto first = static_cast<Index>(soup.points.size());
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            soup.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        }
        return first;
    };
    const auto add = [&](const Triangle& t, int of) {
        soup.triangles.push_back(t);
        soup.triangle_label.push_back(of);
    };
    const auto band = [&](Index a, Index b, int of) {
        for (Index i = 0; i < around; ++i) {
            const Index j = (i + 1) % around;
            add({a + i, a + j, b + j}, of);
            add({a + i, b + j, b + i}, of);
        }
    };
    const auto fan = [&](Index rim, double z, int of) {
        soup.points.emplace_back(0, 0, z);
        const auto middle = static_cast<Index>(soup.points.size()) - 1;
        for (Index i = 0; i < around; ++i) add({middle, rim + i, rim + (i + 1) % around}, of);
    };
    Index low = ring(radii.front(), 0);
    fan(low, 0, label("source"));
    for (std::size_t r = 0; r < radii.size(); ++r) {
        const double top = height * static_cast<double>(r + 1);
        const Index high = ring(radii[r], top);
        band(low, high, label("wall"));
        if (r + 1 == radii.size()) {
            fan(high, top, label("target"));
            break;
        }
        const Index wider = ring(radii[r + 1], top);
        band(high, wider, label("source"));
        low = wider;
    }
    soup.label_keeps_nodes.assign(soup.label_name.size(), 1);
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const std::string& name = model.faces[f].name;
        (name.starts_with("wall")     ? roles.walls
         : name.starts_with("source") ? roles.source
                                      : roles.target)
            .emplace_back(f);
    }
    return open_volume(model, roles);
}

} // namespace

TEST_CASE("pieces of a stepped round bore given as a mesh of triangles are one mesh at any size")
{
    for (const int around : {12, 20, 36}) {
        for (const std::vector<double>& radii :
             {std::vector<double>{1, 2}, std::vector<double>{0.6, 1, 1.5}}) {
            double volume = 0;
            for (const double r : radii) volume += section_area(r, around);
            for (const double size : {0.1, 0.2, 0.35, 0.8}) {
                if (size < 0.2 && around > 12) continue;
                CAPTURE(around);
                CAPTURE(radii.size());
                CAPTURE(size);
                Members members;
                for (const closure::StepPiece& piece : closure::cut_steps(stepped_bore(around, radii, 1)))
                    members.add(closed(piece.volume), size);
                REQUIRE(members.volumes.size() == radii.size());
                check_assembly(sweep::sweep_assembly(members.list()), volume, 1e-3);
            }
        }
    }
}
