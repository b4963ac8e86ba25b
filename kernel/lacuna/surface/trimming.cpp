// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/trimming.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/topology/open_volume.h>
#include <lacuna/topology/shared/facet_area.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Maximum height of a convex curve over its chord, as a share of the chord's length.
/// @param first, second  angles between curve and chord at the two ends [radian].
double height_over_chord(double first, double second)
{
    if (std::max(first, second) > kBendBelow * kDegree) return 1;
    const double a = std::tan(first), b = std::tan(second);
    return a + b > 0 ? a * b / (a + b) : 0;
}

/// State of Newton's method for one closest point of a curve. All points of one edge are computed together.
struct OnCurve {
    double param = 0, difference = 0;
    Vec3 tangent = Vec3::Zero();
};

/// One step for each place. @return  the longest step, as a share of a side
double step_along(const geometry::ExactCurve& curve, std::span<OnCurve> places, std::span<const Vec3> targets,
                  double low, double high)
{
    double longest = 0;
    std::vector<double> params;
    for (OnCurve& place : places) {
        const double middle = std::clamp(place.param, low + place.difference, high - place.difference);
        params.insert(params.end(), {middle - place.difference, middle, middle + place.difference});
    }
    std::vector<Vec3> at(params.size());
    curve.evaluate(params, at);
    for (std::size_t i = 0; i < places.size(); ++i) {
        OnCurve& place = places[i];
        const Vec3 &before = at[3 * i], &here = at[3 * i + 1], &after = at[3 * i + 2];
        const Vec3 first = (after - before) / (2 * place.difference);
        const Vec3 second = (after - 2 * here + before) / (place.difference * place.difference);
        const Vec3 miss = targets[i] - here;
        const double plain = first.squaredNorm(), full = plain - miss.dot(second);
        const double step = miss.dot(first) / (full > plain / 2 ? full : plain);
        // Limit the step to one side.
        const double most = 1 / kDifference * place.difference;
        const double next = params[3 * i + 1] + std::clamp(step, -most, most);
        const double from = std::exchange(place.param, std::clamp(next, low, high));
        place.tangent = first + (place.param - params[3 * i + 1]) * second;
        longest = std::max(longest, std::abs(place.param - from) / most);
    }
    return longest;
}

} // namespace

Trimming::Trimming(const Model& model, FaceId face) : model_(&model), face_(face)
{
    if (model[face].surface == nullptr) return;
    std::unordered_map<std::uint64_t, Index> facet_at;
    const std::vector<Triangle>& facets = model[face].triangles;
    for (std::size_t t = 0; t < facets.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k)
            facet_at[directed_key(facets[t][k], facets[t][(k + 1) % 3])] = static_cast<Index>(t);
    }
    std::vector<Triangle> thin;
    for (const Loop& loop : border_loops(model, face)) {
        std::vector<Index> facet_of_side;
        for (const EdgeUse& use : loop.uses) {
            const std::vector<Index> chain = use_points(model, use);
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                thin.push_back({chain[i], chain[i + 1], chain[i + 1]});
                facet_of_side.push_back(facet_at.at(directed_key(chain[i], chain[i + 1])));
            }
        }
        add_loop(loop, facet_of_side);
    }
    tree_ = geometry::FacetTree(model.points, thin);
}

void Trimming::add_loop(const Loop& loop, const std::vector<Index>& facet_of_side)
{
    const Model& model = *model_;
    const std::size_t first = sides_.size();
    std::vector<Vec3> along;
    for (const EdgeUse& use : loop.uses) {
        const std::vector<Index> chain = use_points(model, use);
        const std::size_t count = chain.size() - 1;
        for (std::size_t i = 0; i < count; ++i) {
            const auto facet = index(facet_of_side[sides_.size() - first]);
            Side side;
            side.use = use;
            side.segment = use.reversed ? count - 1 - i : i;
            side.normal = facet_area_vector(model, model[face_].triangles[facet]).stableNormalized();
            along.push_back(model.at(chain[i + 1]) - model.at(chain[i]));
            side.inward = side.normal.cross(along.back()).stableNormalized();
            sides_.push_back(side);
        }
    }
    const std::size_t count = along.size();
    const auto turn = [&](std::size_t before, std::size_t after) {
        return std::atan2(along[before].cross(along[after]).norm(), along[before].dot(along[after]));
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
        Side& side = sides_[first + i];
        side.inward_at_start = sides_[first + before].inward + side.inward;
        side.inward_at_end = side.inward + sides_[first + after].inward;
        const Edge& edge = model[side.use.edge];
        if (edge.curve == nullptr) continue;
        // The angle between the curve and a side is estimated from the bend of the polyline. At an end of an
        // edge, this bend says nothing about the curve, so the angle at the side's other end is used.
        const bool starts = sides_[first + before].use != side.use || before == i;
        const bool ends = sides_[first + after].use != side.use || after == i;
        const double at_start = turn(before, i), at_end = turn(i, after);
        side.bulge = along[i].norm() * height_over_chord(starts && !ends ? at_end : at_start,
                                                         ends && !starts ? at_start : at_end);
        most_bulge_ = std::max(most_bulge_, side.bulge);
    }
}

/// Distance of the closest point on the facets from the sides of its facet.
double Trimming::to_sides(const Projected& point) const
{
    const Triangle& t = (*model_)[face_].triangles[index(point.triangle)];
    const Vec3 &a = model_->at(t[0]), &b = model_->at(t[1]), &c = model_->at(t[2]);
    const Vec3 lengths((c - b).norm(), (a - c).norm(), (b - a).norm());
    return (b - a).cross(c - a).norm() * point.from->barycentric.cwiseQuotient(lengths).minCoeff();
}

bool Trimming::is_near(const Projected& point, Near& near) const
{
    // The projection cannot have moved the point across a border that is farther away along the face.
    const double reach = (*point.at - point.from->point).norm() + most_bulge_;
    if (reach < to_sides(point) || tree_.closest(point.from->point, reach * reach).triangle < 0) return false;
    const geometry::FacetTree::Hit hit = tree_.closest(*point.at);
    const Side& side = sides_[index(hit.triangle)];
    near.side = index(hit.triangle);
    near.share = hit.barycentric[1];
    near.on_border = hit.point;
    near.inward = near.share <= 0 ? side.inward_at_start : near.share >= 1 ? side.inward_at_end : side.inward;
    return std::sqrt(hit.distance2) <= side.bulge || (*point.at - hit.point).dot(near.inward) < 0;
}

void Trimming::keep_inside(std::span<const Projected> points, const RunContext& context) const
{
    if (sides_.empty()) return;
    std::vector<Near> near(points.size());
    std::vector<char> taken(points.size(), 0);
    parallel_each(context, points.size(), kPerTask, [&](std::size_t i) {
        near[i].point = i;
        taken[i] = is_near(points[i], near[i]) ? 1 : 0;
    });
    std::map<EdgeId, std::vector<Near>> by_edge;
    for (std::size_t i = 0; i < near.size(); ++i) {
        if (taken[i] != 0) by_edge[sides_[near[i].side].use.edge].push_back(near[i]);
    }
    for (auto& [edge, some] : by_edge) {
        if ((*model_)[edge].curve != nullptr) settle(points, some);
        for (const Near& n : some) {
            Vec3& at = *points[n.point].at;
            if ((at - n.on_border).dot(n.inward) < 0) at = n.on_border;
        }
    }
}

void Trimming::settle(std::span<const Projected> points, std::span<Near> near) const
{
    const Edge& edge = (*model_)[sides_[near.front().side].use.edge];
    const auto [low, high] = std::minmax(edge.params.front(), edge.params.back());
    std::vector<OnCurve> places;
    std::vector<Vec3> targets;
    for (const Near& n : near) {
        const Side& side = sides_[n.side];
        const double from = edge.params[side.segment], to = edge.params[side.segment + 1];
        const double share = side.use.reversed ? 1 - n.share : n.share;
        places.push_back({from + share * (to - from), kDifference * std::abs(to - from)});
        targets.push_back(*points[n.point].at);
    }
    for (int step = 0; step < kMostSteps; ++step)
        if (step_along(*edge.curve, places, targets, low, high) <= kSamePlace) break;
    std::vector<double> params;
    for (const OnCurve& place : places) params.push_back(place.param);
    std::vector<Vec3> at(params.size());
    edge.curve->evaluate(params, at);
    const bool rising = edge.params.front() < edge.params.back();
    for (std::size_t i = 0; i < near.size(); ++i) {
        Near& n = near[i];
        const Side& side = sides_[n.side];
        n.on_border = at[i];
        // At an end of the curve, the inward direction of the polyline's corner is kept.
        if (params[i] <= low || params[i] >= high) continue;
        const Vec3 tangent = rising == side.use.reversed ? Vec3(-places[i].tangent) : places[i].tangent;
        n.inward = side.normal.cross(tangent);
    }
}

} // namespace lacuna::surface
