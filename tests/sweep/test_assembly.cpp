// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/dice.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/closure/close.h>
#include <lacuna/healing/split_facets.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/assembly.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::AssemblyMember;
using sweep::SweptAssembly;

namespace {

OpenVolume closed(OpenVolume volume)
{
    const bool ends = !volume.faces(Role::source).empty() && !volume.faces(Role::target).empty();
    closure::close(volume, ends ? matching::match(volume) : matching::Match{});
    return volume;
}

/// A six-sided block between two corners of space, moved by a map, swept along an axis.
struct Brick {
    Vec3 low, high;
    int axis = 2;
    int cuts = 1;                                 ///< facets along each side of a face
    std::function<bool(int side)> drop = nullptr; ///< sides 0 … 5: low and high of x, y, z
    std::function<Vec3(const Vec3&)> map = nullptr;
};

OpenVolume brick(const Brick& b)
{
    healing::FacetSoup soup;
    std::vector<Role> role;
    for (int side = 0; side < 6; ++side) {
        if (b.drop && b.drop(side)) continue;
        const int n = side / 2, u = (n + 1) % 3, v = (n + 2) % 3;
        const auto label = static_cast<int>(role.size());
        role.push_back(n != b.axis ? Role::wall : side % 2 == 0 ? Role::source : Role::target);
        soup.label_name.push_back("side_" + std::to_string(side));
        const auto point = [&](int i, int j) {
            Vec3 p = side % 2 == 0 ? b.low : b.high;
            p[u] = b.low[u] + (b.high[u] - b.low[u]) * i / b.cuts;
            p[v] = b.low[v] + (b.high[v] - b.low[v]) * j / b.cuts;
            soup.points.push_back(b.map ? b.map(p) : p);
            return static_cast<Index>(soup.points.size()) - 1;
        };
        for (int i = 0; i < b.cuts; ++i) {
            for (int j = 0; j < b.cuts; ++j) {
                Quad q{point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)};
                if (side % 2 == 0) std::swap(q[1], q[3]);
                soup.triangles.push_back({q[0], q[1], q[2]});
                soup.triangles.push_back({q[0], q[2], q[3]});
                soup.triangle_label.insert(soup.triangle_label.end(), 2, label);
            }
        }
    }
    healing::SplitOptions split;
    split.whole_labels = true;
    const Model model = healing::split_facets(soup, split);
    Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const int side = std::stoi(model.faces[f].name.substr(5));
        (side / 2 != b.axis ? roles.walls : side % 2 == 0 ? roles.source : roles.target).emplace_back(f);
    }
    return closed(open_volume(model, roles));
}

struct Members {
    std::vector<OpenVolume> volumes;
    std::vector<sweep::SweepOptions> options;

    void add(OpenVolume volume, double size, int layers = 0)
    {
        volumes.push_back(std::move(volume));
        sweep::SweepOptions& own = options.emplace_back();
        own.size = [size](const Vec3&) { return size; };
        own.layers.count = layers;
    }
    [[nodiscard]] std::vector<AssemblyMember> list() const
    {
        std::vector<AssemblyMember> list;
        for (std::size_t m = 0; m < volumes.size(); ++m)
            list.push_back({&volumes[m], options[m], "part_" + std::to_string(m + 1)});
        return list;
    }
};

/// Every part is valid; together the cells are conformal, with as many inner faces more as are shared.
void check_assembly(const SweptAssembly& whole, double volume, double share = 1e-9)
{
    std::vector<Vec3> nodes(whole.nodes);
    std::vector<Hex> hexes;
    double sum = 0;
    for (std::size_t p = 0; p < whole.parts.size(); ++p) {
        const mesh::HexMesh& mesh = whole.parts[p].mesh;
        test::check_valid(mesh);
        sum += whole.parts[p].fidelity.volume;
        for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
            nodes[static_cast<std::size_t>(whole.number[p][n])] = mesh.nodes[n];
        for (std::size_t c = 0; c < mesh.hex_count(); ++c) {
            Hex hex = mesh.hex(c);
            for (Index& n : hex) n = whole.number[p][static_cast<std::size_t>(n)];
            hexes.push_back(hex);
        }
    }
    const quality::Proof proof = quality::prove_cells(nodes, hexes);
    // Volumes that meet along an edge or in a point alone make a skin that is no manifold there.
    if (proof.finding && proof.finding->fault != quality::Fault::pinched &&
        proof.finding->fault != quality::Fault::open_skin)
        FAIL_CHECK(proof.finding->message);
    CHECK(std::abs(sum - volume) <= share * volume);
}

std::size_t inner_quads(const SweptAssembly& whole)
{
    std::size_t count = 0;
    std::map<Quad, int> uses;
    for (std::size_t p = 0; p < whole.parts.size(); ++p) {
        for (std::size_t i = 0; i < whole.parts[p].mesh.skin_count(); ++i) {
            Quad quad = mesh::skin_quad(whole.parts[p].mesh, i).nodes;
            for (Index& n : quad) n = whole.number[p][static_cast<std::size_t>(n)];
            std::sort(quad.begin(), quad.end());
            if (++uses[quad] == 2) ++count;
        }
    }
    return count;
}

} // namespace

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

TEST_CASE("volumes that cover part of a face, or overlap, are refused by name")
{
    Members part;
    part.add(brick({.low = {0, 0, 0}, .high = {2, 1, 1}}), 0.5);
    part.add(brick({.low = {0, 0, 1}, .high = {1, 1, 2}}), 0.5);
    CHECK(test::refusal([&] { sweep::sweep_assembly(part.list()); }, {"50 %", "part_1", "part_2"}) ==
          "assembly.part_of_face");
    Members twice;
    twice.add(brick({.low = {0, 0, 0}, .high = {2, 1, 1}}), 0.5);
    twice.add(brick({.low = {0, 0, 0}, .high = {2, 1, 1}}), 0.5);
    CHECK(test::refusal([&] { sweep::sweep_assembly(twice.list()); }, {"same side"}) == "assembly.overlap");
}

TEST_CASE("a core, the ring round it and a plug on the core are one mesh")
{
    Members members;
    test::PrismOptions core{.sides = 0, .radius = 1, .height = 2, .cuts = 4};
    test::PrismOptions ring{.sides = 0, .radius = 2, .height = 2, .cuts = 4};
    ring.hole_list = {{{0, 0}, 1}};
    members.add(closed(test::prism(core).open()), 0.35);
    members.add(closed(test::prism(ring).open()), 0.5);
    test::PrismOptions plug = core;
    plug.height = 1;
    test::Prism on_top = test::prism(plug);
    on_top.model = test::moved(on_top.model, [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 2)); });
    members.add(closed(on_top.open()), 0.3);
    const SweptAssembly whole = sweep::sweep_assembly(members.list());
    double sealed = 0;
    for (const auto& p : whole.parts) sealed += p.fidelity.sealed_volume;
    check_assembly(whole, sealed, 0.05);
    CHECK(whole.shared.size() == 2);
}

TEST_CASE("grids of blocks swept along axes of their own are one mesh or refused by name")
{
    int meshed = 0, refused = 0;
    std::map<std::string, int> why;
    for (unsigned seed = 1; seed <= 200; ++seed) {
        if (getenv("SEED") && seed != (unsigned)atoi(getenv("SEED"))) continue;
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
        try {
            const SweptAssembly whole = sweep::sweep_assembly(members.list());
            check_assembly(whole, volume, one_axis ? 0.02 : 1e-9);
            ++meshed;
        } catch (const Error& error) {
            ++refused;
            ++why[error.code()];
            MESSAGE(std::string(std::to_string(seed) + ": " + error.what()));
        }
    }
    MESSAGE(meshed << " meshed, " << refused << " refused");
    CHECK(meshed >= 190);
}
