// SPDX-License-Identifier: MIT
#include "support/check_valid.h"
#include "support/refusal.h"
#include "support/volumes.h"
#include "support/whole_families.h"

#include <lacuna/closure/close.h>
#include <lacuna/core/error.h>
#include <lacuna/matching/match.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <string>

using namespace lacuna;
using namespace lacuna::topology;
using test::Part;
using test::PrismOptions;

namespace {

/// What each side of a prism of two rows of walls carries: bit 0 the lower half, bit 1 the upper one.
struct PartialWalls {
    int sides = 4;
    unsigned long carried = 0; ///< two bits a side
    double taper = 1, bend = 0;

    [[nodiscard]] unsigned of(int side) const { return static_cast<unsigned>(carried >> (2 * side)) & 3U; }
    [[nodiscard]] std::string name() const
    {
        const char* const words[] = {"none", "lower", "upper", "full"};
        std::string text;
        for (int side = 0; side < sides; ++side) text += (side > 0 ? " " : "") + std::string(words[of(side)]);
        return text + (taper != 1 ? ", tapered" : "") + (bend != 0 ? ", bent" : "");
    }
};

PrismOptions options_of(const PartialWalls& walls)
{
    PrismOptions o{.sides = walls.sides, .rows = 2, .taper = walls.taper, .bend = walls.bend};
    if (walls.bend != 0) {
        o.height = 4;
        o.levels = 8;
    }
    o.feature_angle = 35;
    o.drop = [walls](const Part& part) {
        return part.role == Role::wall && ((walls.of(part.side) >> part.row) & 1U) == 0;
    };
    return o;
}

enum class End { meshed, refused, wrong };

/// Close and sweep one. Refused by name is well before anything is meshed, and not otherwise.
End run(const PartialWalls& walls, std::string& why)
{
    const auto prism = test::prism(options_of(walls));
    auto volume = prism.open();
    try {
        volume = closure::close(volume, matching::match(volume)).volume;
    } catch (const Error& error) {
        why = error.code() + ": " + error.what();
        return End::refused;
    }
    const double enclosed = closure::enclosed_volume(volume);
    const double off = std::abs(enclosed / prism.facet_volume - 1);
    if (off > (walls.bend != 0 ? 0.02 : 1e-6)) {
        why = "the sealed volume is off by " + std::to_string(off);
        return End::wrong;
    }
    try {
        sweep::SweepOptions options;
        options.layers.count = walls.bend != 0 ? 16 : 4;
        options.size = [](const Vec3&) { return 0.5; };
        const sweep::Swept swept = sweep::sweep(volume, options);
        const double meshed = quality::measure(swept.mesh).volume;
        if (!test::faults(swept.mesh).empty()) why = test::faults(swept.mesh).front();
        if (std::abs(meshed / enclosed - 1) > (walls.bend != 0 ? 0.02 : 1e-6))
            why = "the mesh's volume is off by " + std::to_string(std::abs(meshed / enclosed - 1));
        if (swept.min_scaled_jacobian < 0.2)
            why = "scaled Jacobian " + std::to_string(swept.min_scaled_jacobian);
    } catch (const Error& error) {
        why = error.code() + ": " + error.what();
    }
    return why.empty() ? End::meshed : End::wrong;
}

/// The same walls seen from another side are the same case: only the least of the turns is run.
bool is_least_turn(unsigned long carried, int sides)
{
    const unsigned long all = (1UL << (2 * sides)) - 1;
    unsigned long turned = carried;
    for (int i = 1; i < sides; ++i) {
        turned = ((turned >> 2) | (turned << (2 * sides - 2))) & all;
        if (turned < carried) return false;
    }
    return true;
}

/// How a family ended.
struct Count {
    int meshed = 0, refused = 0, wrong = 0;

    void run(const PartialWalls& walls)
    {
        std::string why;
        const End end = ::run(walls, why);
        (end == End::meshed ? meshed : end == End::refused ? refused : wrong) += 1;
        if (end == End::refused) MESSAGE(walls.name() << ": " << why);
        if (end == End::wrong) FAIL_CHECK(walls.name() << ": " << why);
    }
    void print() const
    {
        MESSAGE(meshed << " meshed right, " << refused << " refused by name, " << wrong << " wrong");
    }
};

/// All of a number of sides, or every third of `most` by chance.
void run_sides(int sides, std::size_t most, const PartialWalls& like, Count& count)
{
    std::mt19937_64 dice(12);
    const unsigned long all = 1UL << (2 * sides);
    if (all <= most) {
        for (unsigned long carried = 0; carried < all; ++carried) {
            if (is_least_turn(carried, sides)) count.run({sides, carried, like.taper, like.bend});
        }
        return;
    }
    test::MembersToRun run(3);
    for (std::size_t i = 0; i < most; ++i) {
        const unsigned long carried = dice() % all;
        if (run.next()) count.run({sides, carried, like.taper, like.bend});
    }
}

} // namespace

TEST_CASE("walls that carry a half each are closed and swept, or refused by name before anything is meshed")
{
    Count count;
    for (int sides = 3; sides <= 8; ++sides) run_sides(sides, 300, {}, count);
    count.print();
}

TEST_CASE("walls that carry a half each, tapered")
{
    Count count;
    for (int sides = 3; sides <= 8; ++sides) run_sides(sides, 100, {.taper = 0.7}, count);
    count.print();
}
