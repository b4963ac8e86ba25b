// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/plane_regions.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/geometry/shared/predicates.h>
#include <lacuna/geometry/shared/signed_area.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lacuna::surface {

namespace {

using Walk = std::vector<PlaneUse>;

std::vector<Vec2> points_of(std::span<const PlaneChain> chains, const Walk& loop)
{
    std::vector<Vec2> points;
    for (const PlaneUse& use : loop) {
        const std::vector<Vec2>& line = chains[use.chain].line;
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            points.push_back(use.reversed ? line[line.size() - 1 - i] : line[i]);
    }
    return points;
}

/// A half-edge that leaves a node.
struct Spoke {
    double angle;
    PlaneUse use;
};

std::map<std::size_t, std::vector<Spoke>> spokes_of(std::span<const PlaneChain> chains)
{
    std::map<std::size_t, std::vector<Spoke>> spokes;
    const auto angle = [](const Vec2& from, const Vec2& to) {
        return std::atan2(to.y() - from.y(), to.x() - from.x());
    };
    for (std::size_t c = 0; c < chains.size(); ++c) {
        const std::vector<Vec2>& line = chains[c].line;
        spokes[chains[c].from].push_back({angle(line[0], line[1]), {c, false}});
        spokes[chains[c].to].push_back({angle(line.back(), line[line.size() - 2]), {c, true}});
    }
    for (auto& [node, around] : spokes) {
        std::ranges::stable_sort(around, {}, &Spoke::angle);
    }
    return spokes;
}

std::vector<Walk> traced_loops(std::span<const PlaneChain> chains)
{
    const std::map<std::size_t, std::vector<Spoke>> spokes = spokes_of(chains);
    const auto number = [](const PlaneUse& use) { return 2 * use.chain + (use.reversed ? 1 : 0); };
    const auto bounds = [&](const PlaneUse& use) {
        return use.reversed ? chains[use.chain].right : chains[use.chain].left;
    };
    // The half-edge after one that arrives at a node: start at its twin, which leaves the node, and turn
    // clockwise to the next half-edge that leaves the node.
    const auto next = [&](const PlaneUse& use) {
        const std::vector<Spoke>& around = spokes.at(use.reversed ? chains[use.chain].from
                                                                  : chains[use.chain].to);
        std::size_t back = 0;
        while (around[back].use.chain != use.chain || around[back].use.reversed == use.reversed) ++back;
        return around[(back + around.size() - 1) % around.size()].use;
    };
    std::vector<bool> done(2 * chains.size(), false);
    std::vector<Walk> loops;
    for (std::size_t h = 0; h < done.size(); ++h) {
        PlaneUse use{h / 2, h % 2 == 1};
        if (done[h] || !bounds(use)) continue;
        Walk& loop = loops.emplace_back();
        for (; !done[number(use)]; use = next(use)) {
            done[number(use)] = true;
            loop.push_back(use);
        }
    }
    return loops;
}

} // namespace

std::vector<PlaneRegion> plane_regions(std::span<const PlaneChain> chains)
{
    std::vector<PlaneRegion> regions;
    std::vector<std::vector<Vec2>> outlines;
    std::vector<double> areas;
    std::vector<Walk> holes;
    for (Walk& loop : traced_loops(chains)) {
        std::vector<Vec2> outline = points_of(chains, loop);
        const double area = geometry::signed_area(outline);
        if (!(area > 0)) {
            holes.push_back(std::move(loop));
            continue;
        }
        regions.push_back({{std::move(loop)}});
        outlines.push_back(std::move(outline));
        areas.push_back(area);
    }
    for (Walk& hole : holes) {
        const PlaneUse& use = hole.front();
        const std::vector<Vec2>& line = chains[use.chain].line;
        const Vec2 at = (line[0] + line[1]) / 2;
        std::size_t round = regions.size();
        double least = kInfinity;
        for (std::size_t r = 0; r < regions.size(); ++r) {
            const bool own = std::ranges::any_of(regions[r].loops.front(),
                                                 [&](const PlaneUse& u) { return u.chain == use.chain; });
            if (own || areas[r] >= least || !geometry::lies_inside(outlines[r], at)) continue;
            round = r;
            least = areas[r];
        }
        if (round < regions.size()) regions[round].loops.push_back(std::move(hole));
    }
    return regions;
}

} // namespace lacuna::surface
