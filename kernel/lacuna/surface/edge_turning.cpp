// SPDX-License-Identifier: MIT
#include <lacuna/surface/detail/edge_turning.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/edge_nodes.h>

#include <algorithm>
#include <cstddef>

namespace lacuna::surface {

using namespace topology;

namespace {

std::vector<Vec3> line_of(const Model& model, EdgeId edge)
{
    if (model[edge].curve == nullptr) return edge_line(model, edge);
    std::vector<double> at;
    for (std::size_t i = 0; i <= kFineChords; ++i) at.push_back(static_cast<double>(i) / kFineChords);
    return edge_points(model, edge, at);
}

double bend(const Vec3& before, const Vec3& at, const Vec3& after)
{
    const Vec3 in = at - before, out = after - at;
    const double angle = geometry::angle_between(in, out);
    return angle < kBendBelow * kDegree ? angle : 0;
}

} // namespace

EdgeTurning::EdgeTurning(const Model& model, EdgeId edge) { append(model, {edge, false}); }

EdgeTurning::EdgeTurning(const Model& model, const std::vector<EdgeUse>& uses)
{
    for (const EdgeUse& use : uses) append(model, use);
}

void EdgeTurning::append(const Model& model, EdgeUse use)
{
    std::vector<Vec3> line = line_of(model, use.edge);
    if (use.reversed) std::ranges::reverse(line);
    const std::vector<double> arc = geometry::arc_lengths(line);
    // Running lengths refer to the model's polyline, which is slightly shorter than the exact curve.
    const double scale = arc.back() > 0 ? edge_length(model, use.edge) / arc.back() : 1;
    const std::size_t sides = line.size() - 1;
    const auto middle = [&](std::size_t side) { return (arc[side] + arc[side + 1]) / 2; };
    std::vector<double> turn(sides + 1, 0.0); // angle from one side to the next, at each point
    for (std::size_t i = 1; i < sides; ++i) turn[i] = bend(line[i - 1], line[i], line[i + 1]);
    const bool closed = model[use.edge].from == model[use.edge].to;
    if (closed && sides > 1) {
        const double seam = bend(line[sides - 1], line[0], line[1]);
        const double first = arc[1], last = arc[sides] - arc[sides - 1];
        turn[0] = first + last > 0 ? seam * first / (first + last) : 0;
        turn[sides] = seam - turn[0];
    } else if (sides > 1) { // the half sides at the ends bend as much per length as the next half sides
        const double low = middle(1) - middle(0), high = middle(sides - 1) - middle(sides - 2);
        turn[0] = low > 0 ? turn[1] * middle(0) / low : 0;
        turn[sides] = high > 0 ? turn[sides - 1] * (arc[sides] - middle(sides - 1)) / high : 0;
    }
    const double start = at_.back();
    for (std::size_t i = 0; i <= sides; ++i) {
        at_.push_back(start + scale * (i < sides ? middle(i) : arc.back()));
        sum_.push_back(sum_.back() + turn[i]);
    }
}

double EdgeTurning::upto(double s) const
{
    const auto after = std::upper_bound(at_.begin(), at_.end(), s);
    if (after == at_.begin()) return 0;
    if (after == at_.end()) return sum_.back();
    const auto i = static_cast<std::size_t>(after - at_.begin());
    return sum_[i - 1] + (s - at_[i - 1]) / (at_[i] - at_[i - 1]) * (sum_[i] - sum_[i - 1]);
}

} // namespace lacuna::surface
