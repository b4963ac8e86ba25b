// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/check_valid.h"
#include "support/whole_families.h"

#include <lacuna/cad/load.h>
#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/branches.h>
#include <lacuna/matching/match.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

constexpr double kPi = std::numbers::pi;

/// A hollow section, revolved about an axis beside it.
struct Bend {
    int sides = 0;     ///< of the section's loops; 0: circles
    double bore = 0.9; ///< size of the inner loop over that of the outer, whose corners are at 3
    double angle = 90; ///< [degrees]
    static constexpr double kRadius = 3, kBend = 10;

    /// Pappus and Guldin.
    [[nodiscard]] double volume() const
    {
        const double unit = sides == 0 ? kPi : sides / 2.0 * std::sin(2 * kPi / sides);
        return unit * kRadius * kRadius * (1 - bore * bore) * kBend * angle * kPi / 180;
    }

    [[nodiscard]] int loop(double radius) const
    {
        if (sides == 0) return occ::addCurveLoop({occ::addCircle(0, 0, 0, radius)});
        std::vector<int> points, lines;
        for (int i = 0; i < sides; ++i) {
            const double at = 2 * kPi * i / sides;
            points.push_back(occ::addPoint(radius * std::cos(at), radius * std::sin(at), 0));
        }
        for (std::size_t i = 0; i < points.size(); ++i)
            lines.push_back(occ::addLine(points[i], points[(i + 1) % points.size()]));
        return occ::addCurveLoop(lines);
    }

    /// Without its outer walls, or without its inner ones.
    void build(bool outer) const
    {
        const int section = occ::addPlaneSurface({loop(kRadius), loop(kRadius * bore)});
        gmsh::vectorpair out;
        occ::revolve({{2, section}}, kBend, 0, 0, 0, 1, 0, angle * kPi / 180, out);
        const std::size_t walls = sides == 0 ? 1 : static_cast<std::size_t>(sides);
        occ::remove({out[1]});
        for (std::size_t i = 0; i < walls; ++i) occ::remove({out[2 + i + (outer ? 0 : walls)]}, true);
    }
};

/// The flat faces with two loops are the ends.
topology::OpenVolume opened(const topology::Model& model)
{
    topology::Roles roles;
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        const bool end = model.faces[f].kind == "plane" && model.faces[f].loops.size() == 2;
        (!end ? roles.walls : roles.source.empty() ? roles.source : roles.target).emplace_back(f);
    }
    REQUIRE(roles.target.size() == 1);
    return topology::open_volume(model, roles);
}

} // namespace

TEST_CASE("thin bends of CAD files without their outer or inner walls are filled to the volume they have, "
          "whatever the turn, with as many layers as that takes")
{
    const test::TempFolder folder;
    int bends = 0;
    double worst = 0;
    test::MembersToRun run(3);
    for (const int sides : {0, 6}) {
        for (const double bore : {0.6, 0.9}) {
            for (const double angle : {20.0, 90.0, 180.0, 300.0}) {
                for (const bool outer : {true, false}) {
                    if (!run.next()) continue;
                    const Bend bend{sides, bore, angle};
                    CAPTURE(sides);
                    CAPTURE(bore);
                    CAPTURE(angle);
                    CAPTURE(outer);
                    const std::string path = folder.gmsh("bend.brep", [&] { bend.build(outer); });
                    topology::OpenVolume volume = opened(cad::load({path}));
                    const matching::Match match = matching::match(volume);
                    CHECK(!closure::has_pieces(volume));
                    volume = closure::close(volume, match).volume;
                    const sweep::Swept swept = sweep::sweep(volume, {});
                    test::check_valid(swept.mesh);
                    const double off = swept.fidelity.volume / bend.volume() - 1;
                    CHECK(std::abs(off) < 0.02);
                    worst = std::max(worst, std::abs(off));
                    ++bends;
                }
            }
        }
    }
    MESSAGE(bends << " bends, off by " << 100 * worst << " % at most");
}
