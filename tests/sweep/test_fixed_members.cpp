// SPDX-License-Identifier: MIT
#include "support/assemblies.h"
#include "support/check_valid.h"
#include "support/dice.h"
#include "support/refusal.h"
#include "support/volumes.h"

#include <lacuna/io/shared/mesh_skin.h>

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;
using sweep::AssemblyMember;
using sweep::Swept;
using sweep::SweptAssembly;
using test::Brick;
using test::brick;

namespace {

/// A mesh made before, and its skin.
struct Fixed {
    Swept swept;
    io::MeshSkin skin;

    explicit Fixed(Swept made) : swept(std::move(made)), skin(io::skin_of(swept.mesh))
    {
        swept.faces = skin.face;
    }
    [[nodiscard]] AssemblyMember member(const std::string& region) const
    {
        AssemblyMember member{&skin.volume, {}, region, &swept};
        member.options.order = swept.mesh.order();
        return member;
    }
};

sweep::SweepOptions sized(double size)
{
    sweep::SweepOptions options;
    options.size = [size](const Vec3&) { return size; };
    return options;
}

/// Cells of a part are those it came with, node for node.
void check_unchanged(const Swept& part, const Swept& before)
{
    CHECK(part.mesh.nodes == before.mesh.nodes);
    CHECK(part.mesh.quads == before.mesh.quads);
    CHECK(part.mesh.layers == before.mesh.layers);
}

} // namespace

TEST_CASE("a skin has a face for each patch, which keeps its quads, and encloses what the mesh does")
{
    for (const int sides : {0, 3, 5}) {
        CAPTURE(sides);
        const OpenVolume volume = test::closed(test::prism({.sides = sides, .holes = 1}).open());
        const Fixed fixed(sweep::sweep(volume, sized(0.4)));
        const Model& model = fixed.skin.volume.model;
        CHECK(model.faces.size() == fixed.swept.mesh.patches.size());
        CHECK(free_edges(fixed.skin.volume).empty());
        std::size_t quads = 0;
        std::vector<FaceId> all;
        for (std::size_t f = 0; f < model.faces.size(); ++f) {
            CHECK(model.faces[f].keeps_nodes);
            CHECK(has_quads_all_over(model.faces[f]));
            quads += model.faces[f].given_quads.size();
            all.emplace_back(f);
        }
        CHECK(quads == fixed.swept.mesh.skin_count());
        CHECK(volume_integral(model, all) == doctest::Approx(fixed.swept.fidelity.volume).epsilon(0.01));
    }
}

TEST_CASE("volumes beside a mesh that was made before match it node for node, and it stays as it was")
{
    int meshed = 0;
    test::Refusals refused;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        CAPTURE(seed);
        test::Dice dice(seed);
        // A block meshed by itself, with layers that grow, and blocks on some of its sides.
        Brick middle{.low = {0, 0, 0}, .high = {dice.between(1, 2), dice.between(1, 2), dice.between(1, 2)}};
        middle.axis = dice.whole(0, 2);
        sweep::SweepOptions own = sized(dice.between(0.2, 0.5));
        own.layers.count = dice.whole(2, 5);
        own.layers.bias = dice.between(0.6, 1.8);
        if (dice.chance(0.4)) own.quads = sweep::Quads::paved;
        const Fixed fixed(sweep::sweep(brick(middle), own));
        std::vector<OpenVolume> volumes;
        double volume = middle.high.prod();
        for (int side = 0; side < 6; ++side) {
            if (!dice.chance(0.35) && !(side == 5 && volumes.empty())) continue;
            Brick beside = middle;
            const int n = side / 2;
            const double thick = dice.between(0.4, 1.5);
            (side % 2 == 0 ? beside.high : beside.low)[n] = side % 2 == 0 ? middle.low[n] : middle.high[n];
            (side % 2 == 0 ? beside.low : beside.high)[n] = (side % 2 == 0 ? -thick : middle.high[n] + thick);
            beside.axis = dice.chance(0.7) ? n : dice.whole(0, 2);
            beside.cuts = dice.whole(1, 3);
            const int gone = dice.whole(0, 5); // the shared face too: what the mesh has there is its shape
            if (gone / 2 != beside.axis) beside.drop = [gone](int s) { return s == gone; };
            volumes.push_back(brick(beside));
            volume += (beside.high - beside.low).prod();
        }
        std::vector<AssemblyMember> members;
        for (std::size_t m = 0; m < volumes.size(); ++m)
            members.push_back({&volumes[m], sized(dice.between(0.2, 0.6)), "made_" + std::to_string(m)});
        const std::size_t at = dice.chance(0.5) ? 0 : members.size();
        members.insert(members.begin() + static_cast<std::ptrdiff_t>(at), fixed.member("given"));
        try {
            const SweptAssembly whole = sweep::sweep_assembly(members);
            test::check_assembly(whole, volume);
            check_unchanged(whole.parts[at], fixed.swept);
            CHECK(whole.shared.size() >= volumes.size());
            CHECK(test::inner_quads(whole) > 0);
            CHECK(whole.near_misses.empty());
            ++meshed;
        } catch (const Error& error) {
            refused.add(seed, error);
        }
    }
    MESSAGE(meshed << " meshed, refused:" << refused.in_words());
    CHECK(meshed >= 50);
}

TEST_CASE("a round mesh made before takes its ring and its plug, of either order")
{
    for (const int order : {1, 2}) {
        for (const double size : {0.2, 0.5}) {
            CAPTURE(order);
            CAPTURE(size);
            const test::PrismOptions core{.sides = 0, .radius = 1, .height = 2, .cuts = 4};
            sweep::SweepOptions own = sized(size);
            own.order = order;
            const Fixed fixed(sweep::sweep(test::closed(test::prism(core).open()), own));
            test::PrismOptions round = core;
            round.radius = 2;
            round.hole_list = {{{0, 0}, 1}};
            const OpenVolume ring = test::closed(test::prism(round).open());
            test::Prism plug = test::prism(core);
            plug.model = test::moved(plug.model, [](const Vec3& p) { return Vec3(p + Vec3(0, 0, 2)); });
            const OpenVolume above = test::closed(plug.open());
            sweep::SweepOptions options = sized(0.4);
            options.order = order;
            const std::vector<AssemblyMember> members{
                fixed.member("core"), {&ring, options, "ring"}, {&above, options, "plug"}};
            const SweptAssembly whole = sweep::sweep_assembly(members);
            CHECK(whole.shared.size() == 2);
            check_unchanged(whole.parts[0], fixed.swept);
            for (const Swept& part : whole.parts) test::check_valid(part.mesh);
            CHECK(test::inner_quads(whole) > 0);
        }
    }
}

TEST_CASE("fixed members alone share their nodes and stay as they are")
{
    const Fixed low(sweep::sweep(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), sized(0.5)));
    const Fixed high(sweep::sweep(brick({.low = {0, 0, 1}, .high = {1, 1, 2}}), sized(0.5)));
    const std::vector<AssemblyMember> members{low.member("low"), high.member("high")};
    const SweptAssembly whole = sweep::sweep_assembly(members);
    CHECK(whole.shared.size() == 1);
    CHECK(whole.nodes == 3 * 3 * 5);
    check_unchanged(whole.parts[0], low.swept);
    check_unchanged(whole.parts[1], high.swept);
}

TEST_CASE("a fixed member of another order is refused by name")
{
    const Fixed fixed(sweep::sweep(brick({.low = {0, 0, 0}, .high = {1, 1, 1}}), sized(0.5)));
    const OpenVolume volume = brick({.low = {0, 0, 1}, .high = {1, 1, 2}});
    sweep::SweepOptions curved = sized(0.5);
    curved.order = 2;
    const std::vector<AssemblyMember> mixed{fixed.member("given"), {&volume, curved, "made"}};
    CHECK(test::refusal([&] { sweep::sweep_assembly(mixed); }, {"given", "made"}) == "assembly.order");
}

TEST_CASE("a volume that covers part of a fixed mesh's face is refused by name, and the mesh stays whole")
{
    const Fixed fixed(sweep::sweep(brick({.low = {0, 0, 0}, .high = {2, 2, 1}}), sized(0.5)));
    const OpenVolume volume = brick({.low = {0.3, 0.3, 1}, .high = {1.2, 1.2, 2}});
    const std::vector<AssemblyMember> members{fixed.member("given"), {&volume, sized(0.5), "made"}};
    CHECK(test::refusal([&] { sweep::sweep_assembly(members); }, {"given", "made", "must not change"}) ==
          "assembly.part_of_face");
}
