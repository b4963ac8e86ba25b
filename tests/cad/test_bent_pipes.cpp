// SPDX-License-Identifier: GPL-2.0-or-later
#include "made_files.h"
#include "support/bent_pipes.h"
#include "support/check_valid.h"

#include <lacuna/cad/load.h>
#include <lacuna/closure/close.h>
#include <lacuna/matching/match.h>
#include <lacuna/sweep/sweep.h>

#include <doctest/doctest.h>
#include <gmsh.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

using namespace lacuna;
namespace occ = gmsh::model::occ;

namespace {

/// The wall of a round pipe of radius 1, a face a leg.
void build(const std::vector<test::Leg>& legs)
{
    const auto point = [](const Vec3& p) { return occ::addPoint(p.x(), p.y(), p.z()); };
    std::vector<int> curves;
    test::Frame frame;
    int from = point(frame.at);
    for (const test::Leg& leg : legs) {
        const test::Frame end = test::carried(frame, leg, 1);
        const int to = point(end.at);
        if (leg.bend == 0) {
            curves.push_back(occ::addLine(from, to));
        } else {
            const double radius = leg.length / (leg.bend * test::kDegree),
                         towards = leg.towards * test::kDegree;
            const Vec3 centre = frame.at + radius * (std::cos(towards) * frame.across +
                                                     std::sin(towards) * frame.beside());
            curves.push_back(occ::addCircleArc(from, point(centre), to));
        }
        frame = end;
        from = to;
    }
    gmsh::vectorpair out;
    occ::addPipe({{1, occ::addCircle(0, 0, 0, 1)}}, occ::addWire(curves), out);
}

} // namespace

TEST_CASE("columns of bent pipes of CAD files keep their angles, and the volume is kept")
{
    const test::TempFolder folder;
    int pipes = 0;
    for (const auto& [way, legs] : test::bent_axes()) {
        CAPTURE(way);
        const std::string path = folder.gmsh("pipe.brep", [&, &legs = legs] { build(legs); });
        const topology::Model model = cad::load({path});
        topology::Roles roles;
        for (std::size_t f = 0; f < model.faces.size(); ++f) roles.walls.emplace_back(f);
        topology::OpenVolume volume = topology::open_volume(model, roles);
        volume = closure::close(volume, {}).volume;
        sweep::SweepOptions options;
        options.size = [](const Vec3&) { return 0.3; };
        const sweep::Swept swept = sweep::sweep(volume, options);
        test::check_valid(swept.mesh);
        CHECK(swept.min_scaled_jacobian >= 0.5);
        const test::Drift drift = test::drift_of_columns(test::frames_along(legs), swept.mesh);
        CHECK(drift.turned <= 3);
        CHECK(drift.crowded <= 0.1);
        double length = 0;
        for (const test::Leg& leg : legs) length += leg.length;
        CHECK(std::abs(swept.quality.volume / (std::numbers::pi * length) - 1) < 0.03); // of a given size
        ++pipes;
    }
    MESSAGE(pipes << " pipes");
}
