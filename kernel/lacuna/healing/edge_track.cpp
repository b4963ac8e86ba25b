// SPDX-License-Identifier: MIT
#include <lacuna/healing/detail/edge_track.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/topology/shared/side_points.h>

#include <algorithm>
#include <cmath>

namespace lacuna::healing {

EdgeTrack::EdgeTrack(const topology::Model& model, EdgeId id, const RunContext& context)
{
    const topology::Edge& edge = model[id];
    for (const Index p : edge.points) points_.push_back(model.at(p));
    if (edge.curve && edge.params.size() == edge.points.size()) {
        curve_ = edge.curve;
        per_side_ = 2;
        std::vector<double> middle_params;
        for (std::size_t i = 0; i + 1 < edge.params.size(); ++i)
            middle_params.push_back((edge.params[i] + edge.params[i + 1]) / 2);
        std::vector<Vec3> middles(middle_params.size());
        curve_->evaluate(middle_params, middles, context);
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            points.push_back(points_[i]);
            params_.push_back(edge.params[i]);
            if (i == middles.size()) break;
            // The sagitta of a whole side is used as a bound for that of half a side, which on a circle is a
            // quarter of it.
            sagitta_ = std::max(sagitta_, (middles[i] - (points_[i] + points_[i + 1]) / 2).norm());
            points.push_back(middles[i]);
            params_.push_back(middle_params[i]);
        }
        points_ = std::move(points);
    }
    for (std::size_t i = 0; i + 1 < points_.size(); ++i) length_ += (points_[i + 1] - points_[i]).norm();
}

EdgeTrack::EdgePosition EdgeTrack::on_segment(const Vec3& p, std::size_t i) const
{
    const double f = topology::fraction_along(p, points_[i], points_[i + 1]);
    EdgePosition place;
    place.s = (static_cast<double>(i) + f) / per_side_;
    if (curve_) place.param = params_[i] + f * (params_[i + 1] - params_[i]);
    place.at = points_[i] + f * (points_[i + 1] - points_[i]);
    place.distance = (place.at - p).norm();
    return place;
}

/// Refine all positions within `reach` together, by Gauss-Newton steps along the curve. Tangents are finite
/// differences.
void EdgeTrack::refine(std::span<const Vec3> points, std::span<EdgePosition> places, double reach,
                       const RunContext& context) const
{
    if (!curve_) return;
    std::vector<std::size_t> active;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (places[i].distance <= reach) active.push_back(i);
    if (active.empty()) return;
    const auto side_of = [&](double s) {
        return std::min(static_cast<std::size_t>(s * per_side_), params_.size() - 2);
    };
    std::vector<double> t;
    std::vector<double> h;
    for (const std::size_t i : active) {
        const std::size_t side = side_of(places[i].s);
        t.push_back(places[i].param);
        h.push_back(kDifference * (params_[side + 1] - params_[side]));
    }
    const double low = std::min(params_.front(), params_.back());
    const double high = std::max(params_.front(), params_.back());
    std::vector<double> asked(3 * t.size());
    std::vector<Vec3> at(asked.size());
    for (int step = 0; step < kMostSteps; ++step) {
        for (std::size_t k = 0; k < t.size(); ++k) {
            asked[3 * k] = t[k];
            asked[3 * k + 1] = std::clamp(t[k] - h[k], low, high);
            asked[3 * k + 2] = std::clamp(t[k] + h[k], low, high);
        }
        curve_->evaluate(asked, at, context);
        bool still = true;
        for (std::size_t k = 0; k < t.size(); ++k) {
            const Vec3& p = points[active[k]];
            const double width = asked[3 * k + 2] - asked[3 * k + 1];
            const Vec3 tangent = width != 0 ? Vec3((at[3 * k + 2] - at[3 * k + 1]) / width) : Vec3::Zero();
            places[active[k]].param = t[k];
            places[active[k]].at = at[3 * k];
            places[active[k]].distance = (at[3 * k] - p).norm();
            if (!(tangent.squaredNorm() > 0)) continue;
            const double next = t[k] + (p - at[3 * k]).dot(tangent) / tangent.squaredNorm();
            still = still && std::abs(next - t[k]) <= kRoundoff * (high - low);
            t[k] = std::clamp(next, low, high);
        }
        if (still) break;
    }
    // Convert the parameter back to a position on the polyline.
    const bool rising = params_.back() > params_.front();
    for (const std::size_t i : active) {
        const double param = places[i].param;
        const auto after = std::upper_bound(params_.begin() + 1, params_.end() - 1, param,
                                            [&](double a, double b) { return rising ? a < b : a > b; });
        const auto side = static_cast<std::size_t>(after - params_.begin()) - 1;
        const double width = params_[side + 1] - params_[side];
        const double f = width != 0 ? std::clamp((param - params_[side]) / width, 0.0, 1.0) : 0;
        places[i].s = (static_cast<double>(side) + f) / per_side_;
    }
}

std::vector<EdgeTrack::EdgePosition> EdgeTrack::locate(std::span<const Vec3> points, double tolerance,
                                                       const RunContext& context) const
{
    std::vector<EdgePosition> places(points.size());
    for (std::size_t q = 0; q < points.size(); ++q) {
        check_cancelled(context);
        places[q].distance = kInfinity;
        for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
            const EdgePosition place = on_segment(points[q], i);
            if (place.distance < places[q].distance) places[q] = place;
        }
    }
    refine(points, places, tolerance + sagitta_, context);
    return places;
}

std::optional<std::vector<EdgeTrack::EdgePosition>> EdgeTrack::follow(std::span<const Vec3> points,
                                                                      double tolerance,
                                                                      const RunContext& context) const
{
    const double reach = tolerance + sagitta_;
    std::vector<EdgePosition> places(points.size());
    std::size_t from = 0;
    double least = 0;
    Vec3 before = points_.front();
    for (std::size_t q = 0; q < points.size(); ++q) {
        // Length of the edge in which the next point is searched. If the edge between two points were longer
        // than four chords, it would deviate from the followed edge by more than the tolerance.
        double window = 4 * ((points[q] - before).norm() + 2 * reach) +
                        (points_[from + 1] - points_[from]).norm();
        places[q].distance = kInfinity;
        std::size_t best = from;
        for (std::size_t i = from; i + 1 < points_.size() && window >= 0; ++i) {
            EdgePosition place = on_segment(points[q], i);
            if (place.distance < places[q].distance) {
                places[q] = place;
                best = i;
            }
            window -= (points_[i + 1] - points_[i]).norm();
        }
        if (places[q].distance > reach) return std::nullopt;
        from = best;
        before = points[q];
    }
    refine(points, places, reach, context);
    for (EdgePosition& place : places) {
        if (place.distance > tolerance) return std::nullopt;
        least = place.s = std::max(place.s, least);
    }
    return places;
}

double greatest_gap(const EdgeTrack& a, const EdgeTrack& b, double tolerance, const RunContext& context)
{
    double gap = 0;
    for (const EdgeTrack::EdgePosition& place : b.locate(a.samples(), tolerance, context))
        gap = std::max(gap, place.distance);
    for (const EdgeTrack::EdgePosition& place : a.locate(b.samples(), tolerance, context))
        gap = std::max(gap, place.distance);
    return gap;
}

} // namespace lacuna::healing
