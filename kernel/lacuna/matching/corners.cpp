// SPDX-License-Identifier: MIT
#include <lacuna/matching/shared/corners.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/angle.h>

#include <algorithm>
#include <numbers>

namespace lacuna::matching {

using namespace topology;

namespace {

/// A corner turns by more than this factor times the turn between the facets next to it. The turns between
/// facets of one curve differ by less than this factor.
constexpr double kOverSmooth = 1.5;

double turn(const Vec3& in, const Vec3& out)
{
    return geometry::angle_between(in, out) * 180 / std::numbers::pi;
}

/// Turn between the first two sides of a chain, or the last two [degrees].
double bend_at_end(const Model& model, const std::vector<Index>& points, bool first)
{
    if (points.size() < 3) return 0;
    const std::size_t k = first ? 1 : points.size() - 2;
    return turn(model.at(points[k]) - model.at(points[k - 1]), model.at(points[k + 1]) - model.at(points[k]));
}

} // namespace

bool is_corner(const Model& model, const std::vector<EdgeUse>& walk, std::size_t i)
{
    const std::vector<Index> before = use_points(model, walk[(i + walk.size() - 1) % walk.size()]);
    const std::vector<Index> after = use_points(model, walk[i]);
    const double here = turn(model.at(before.back()) - model.at(before[before.size() - 2]),
                             model.at(after[1]) - model.at(after[0]));
    const double smooth = std::max(bend_at_end(model, before, false), bend_at_end(model, after, true));
    return here > std::max(kCreaseAngle / 2, kOverSmooth * smooth);
}

} // namespace lacuna::matching
