// SPDX-License-Identifier: MIT
//
// Each free edge needs the closest edge of another part. For each binary digit of the part numbers there are
// two trees: one of the edges of parts with digit 0, one of the edges of parts with digit 1. Two different
// parts differ in at least one digit, so a search in the trees of the opposite digits finds every other part,
// and never the edge's own part.
#include <lacuna/topology/shared/gaps.h>

#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace lacuna::topology {

namespace {

/// Free edges as degenerate facets.
struct Lines {
    std::vector<Triangle> sides;
    std::vector<EdgeId> owner;
};

} // namespace

std::vector<Gap> gaps(const Model& model, const RunContext& context)
{
    const std::vector<std::vector<FaceId>> parts = connected_parts(model, all_faces(model));
    std::vector<std::size_t> part_of(model.faces.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const FaceId face : parts[p]) part_of[face.index()] = p;
    std::vector<EdgeId> free;
    for (std::size_t e = 0; e < model.edges.size(); ++e)
        if (model.uses_of_edge(EdgeId(e)).size() == 1) free.emplace_back(e);
    const auto part = [&](EdgeId edge) { return part_of[model.uses_of_edge(edge).front().face.index()]; };

    const double reach = kMostTolerance * model.diagonal;
    // The points of each free edge, followed by its middle. The edge that is closest to the middle is
    // reported, because several edges may be equally close to an end of the edge.
    std::vector<std::vector<Vec3>> places(free.size());
    std::vector<std::vector<Gap>> nearest(free.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
        const std::vector<Index>& chain = model[free[i]].points;
        places[i] = places_at(model, chain);
        const std::size_t half = chain.size() / 2;
        places[i].push_back((model.at(chain[half - 1]) + model.at(chain[half])) / 2);
        nearest[i].resize(places[i].size());
    }
    for (std::size_t bit = 1; bit < parts.size(); bit *= 2) {
        check_cancelled(context);
        std::array<Lines, 2> lines;
        for (const EdgeId edge : free) {
            Lines& own = lines[(part(edge) & bit) != 0 ? 1 : 0];
            const std::vector<Index>& chain = model[edge].points;
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                own.sides.push_back({chain[i], chain[i + 1], chain[i + 1]});
                own.owner.push_back(edge);
            }
        }
        const std::array<geometry::FacetTree, 2> trees{geometry::FacetTree(model.points, lines[0].sides),
                                                       geometry::FacetTree(model.points, lines[1].sides)};
        for (std::size_t i = 0; i < free.size(); ++i) {
            const std::size_t other = (part(free[i]) & bit) != 0 ? 0 : 1;
            for (std::size_t k = 0; k < places[i].size(); ++k) {
                const auto hit = trees[other].closest(places[i][k], reach * reach);
                if (hit.triangle < 0 || !(std::sqrt(hit.distance2) < nearest[i][k].width)) continue;
                nearest[i][k] = {free[i], lines[other].owner[index(hit.triangle)], std::sqrt(hit.distance2)};
            }
        }
    }
    std::vector<Gap> found;
    for (const std::vector<Gap>& along : nearest) {
        const auto widest = std::ranges::max_element(along, {}, &Gap::width);
        if (std::isfinite(widest->width))
            found.push_back({along.back().own, along.back().other, widest->width});
    }
    std::ranges::stable_sort(found, {}, &Gap::width);
    std::vector<Gap> once;
    std::set<std::pair<EdgeId, EdgeId>> known;
    for (const Gap& gap : found) {
        if (known.insert(std::minmax(gap.own, gap.other)).second) once.push_back(gap);
    }
    return once;
}

double sewing_tolerance(const Model& model, const Gap& gap)
{
    const double width = std::max(gap.width, model.tolerance);
    const double power = std::pow(10, std::floor(std::log10(width)) - 1);
    return std::ceil(1.01 * width / power) * power;
}

} // namespace lacuna::topology
