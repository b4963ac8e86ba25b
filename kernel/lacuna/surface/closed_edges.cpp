// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/closed_edges.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/plane.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/detail/flat_ends.h>
#include <lacuna/surface/detail/imprint_rules.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

namespace lacuna::surface {

using namespace topology;

namespace {

/// A closed edge in the plane.
struct Circle {
    EdgeId edge;
    Vec2 centre = Vec2::Zero();
    double area = 0;           ///< signed
    std::vector<Vec2> line;    ///< closed: the last point repeats the first
    std::vector<double> share; ///< position of each point of `line`, as a share of the edge's length
    [[nodiscard]] double radius() const { return std::sqrt(std::abs(area) / std::numbers::pi); }
};

/// Smooth closed edges that meet no other edge.
std::vector<Circle> circles(const Model& model, const EndsMap& map, bool target,
                            std::span<const EdgeId> edges)
{
    std::map<VertexId, int> ends;
    for (const Edge& edge : model.edges) {
        ++ends[edge.from];
        ++ends[edge.to];
    }
    std::vector<Circle> found;
    for (const EdgeId id : edges) {
        const Edge& edge = model[id];
        if (edge.from != edge.to || ends[edge.from] != 2) continue;
        const Vec3 out = model.at(edge.points[1]) - model.at(edge.points[0]);
        const Vec3 in = model.at(edge.points.back()) - model.at(edge.points[edge.points.size() - 2]);
        if (out.dot(in) < kContinues * out.norm() * in.norm()) continue;
        const FlatEdge flat = flat_edge(model, map, id, target);
        Circle circle{id, Vec2::Zero(), 0, flat.line, flat.at};
        for (std::size_t i = 0; i + 1 < flat.line.size(); ++i) {
            const Vec2 &a = flat.line[i], &b = flat.line[i + 1];
            const double turn = geometry::cross(a, b) / 2;
            circle.area += turn;
            circle.centre += turn * (a + b) / 3;
        }
        if (!(std::abs(circle.area) > 0)) continue;
        circle.centre /= circle.area;
        found.push_back(std::move(circle));
    }
    return found;
}

/// Dissimilarity of two closed edges: (distance of their centres + difference of their radii) / larger
/// radius.
double unlike(const Circle& a, const Circle& b)
{
    return ((a.centre - b.centre).norm() + std::abs(a.radius() - b.radius())) /
           std::max(a.radius(), b.radius());
}

/// Directions from the centre to points at even steps along a closed edge [radian].
std::vector<double> directions(const Circle& circle, std::size_t steps)
{
    std::vector<double> result;
    for (std::size_t k = 0; k < steps; ++k) {
        const geometry::PolylinePlace at = geometry::place_at(circle.share, static_cast<double>(k) /
                                                                                static_cast<double>(steps));
        const Vec2 p = (1 - at.fraction) * circle.line[at.segment] +
                       at.fraction * circle.line[at.segment + 1] - circle.centre;
        result.push_back(std::atan2(p.y(), p.x()));
    }
    return result;
}

/// Pair two closed edges. Find the position on the target's edge that corresponds to the start of the
/// source's edge, as `alike_closed_edges()` describes.
ClosedPair turned(const Circle& low, const Circle& high)
{
    const std::vector<double> a = directions(low, kDegreesPerTurn), b = directions(high, kDegreesPerTurn);
    const bool back = (low.area > 0) != (high.area > 0);
    std::size_t best = 0;
    double most = -2;
    for (std::size_t shift = 0; shift < kDegreesPerTurn; ++shift) {
        double sum = 0;
        for (std::size_t k = 0; k < kDegreesPerTurn; ++k)
            sum += std::cos(a[k] - b[(back ? shift + kDegreesPerTurn - k : shift + k) % kDegreesPerTurn]);
        if (sum <= most) continue;
        most = sum;
        best = shift;
    }
    const double from = static_cast<double>(best) / kDegreesPerTurn;
    return {low.edge, high.edge, from, back ? from - 1 : from + 1};
}

} // namespace

std::vector<ClosedPair> alike_closed_edges(const Model& model, const EndsMap& map,
                                           std::span<const EdgeId> source, std::span<const EdgeId> target)
{
    const std::vector<Circle> low = circles(model, map, false, source);
    const std::vector<Circle> high = circles(model, map, true, target);
    std::vector<ClosedPair> pairs;
    std::set<std::size_t> used_low, used_high;
    for (;;) {
        double least = kAlikeLoops;
        std::optional<std::pair<std::size_t, std::size_t>> best;
        for (std::size_t i = 0; i < low.size(); ++i) {
            for (std::size_t j = 0; j < high.size(); ++j) {
                if (used_low.contains(i) || used_high.contains(j) || unlike(low[i], high[j]) >= least)
                    continue;
                least = unlike(low[i], high[j]);
                best = {i, j};
            }
        }
        if (!best) return pairs;
        used_low.insert(best->first);
        used_high.insert(best->second);
        pairs.push_back(turned(low[best->first], high[best->second]));
    }
}

} // namespace lacuna::surface
