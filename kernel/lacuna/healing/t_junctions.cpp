// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/t_junctions.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/healing/detail/facet_sides.h>
#include <lacuna/topology/shared/side_points.h>

#include <algorithm>

namespace lacuna::healing {

std::vector<FacetPiece> cut_at_t_junctions(std::span<const Vec3> points, std::span<const Triangle> facets,
                                           const std::vector<bool>& whole, double tolerance,
                                           const RunContext& context)
{
    const FacetSides all(facets, points.size());
    check_cancelled(context);
    std::vector<Index> candidates;
    std::vector<Vec3> at;
    std::vector<std::array<Vec3, 2>> segments;
    std::vector<std::array<Index, 3>> ends; // by free side: its ends, and the opposite corner of its facet
    for (Index s = 0; s < static_cast<Index>(3 * facets.size()); ++s) {
        if (all.on(all.segment(s)).size() != 1) continue;
        const Triangle& f = facets[index(s) / 3];
        const std::size_t k = index(s) % 3;
        candidates.push_back(f[k]);
        candidates.push_back(f[(k + 1) % 3]);
        if (whole[index(s) / 3]) continue;
        ends.push_back({f[k], f[(k + 1) % 3], f[(k + 2) % 3]});
        segments.push_back({points[index(f[k])], points[index(f[(k + 1) % 3])]});
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    for (const Index p : candidates) at.push_back(points[index(p)]);

    std::vector<std::vector<std::pair<double, Index>>> on_side(segments.size());
    const std::vector<topology::NearSegment> near = topology::near_segments(at, segments, tolerance, context);
    check_cancelled(context);
    for (const topology::NearSegment& pair : near) {
        const Index p = candidates[index(pair.point)];
        const auto& side = ends[index(pair.segment)];
        if (std::find(side.begin(), side.end(), p) != side.end()) continue;
        const auto& [a, b] = segments[index(pair.segment)];
        const double f = topology::fraction_along(points[index(p)], a, b);
        if (f <= 0 || f >= 1 || (a + f * (b - a) - points[index(p)]).norm() > tolerance) continue;
        on_side[index(pair.segment)].emplace_back(f, p);
    }
    topology::SidePoints sides;
    for (std::size_t s = 0; s < on_side.size(); ++s) {
        std::sort(on_side[s].begin(), on_side[s].end());
        std::vector<Index> between;
        for (const auto& [f, p] : on_side[s]) between.push_back(p);
        sides.add(ends[s][0], ends[s][1], std::move(between));
    }
    if (sides.empty()) return {};
    std::vector<FacetPiece> pieces;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (f % kBetweenPolls == 0) check_cancelled(context);
        for (const topology::ParamFacet& part : topology::cut_at_sides(points, {facets[f]}, sides))
            pieces.push_back({part.corner, static_cast<Index>(f)});
    }
    return pieces;
}

} // namespace lacuna::healing
