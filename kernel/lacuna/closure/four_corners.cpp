// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/four_corners.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/geometry/shared/swept_patch.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <array>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Difference between the third side and the first side moved along the second and the fourth, see
/// `SweptPatch::unlike()`.
double unlike(const Model& model, const std::vector<std::vector<EdgeUse>>& sides)
{
    std::array<std::vector<Vec3>, 4> side;
    for (std::size_t i = 0; i < 4; ++i) side[i] = use_places(model, sides[i]);
    for (const std::size_t i : {2, 3}) std::reverse(side[i].begin(), side[i].end());
    return geometry::SweptPatch(side[0], side[1], side[2], side[3]).unlike();
}

} // namespace

bool is_straight(const Model& model, const std::vector<EdgeUse>& side)
{
    const std::vector<Vec3> points = use_places(model, side);
    const Vec3 chord = points.back() - points.front();
    const Vec3 along = chord.stableNormalized();
    return chord.norm() > model.tolerance && std::ranges::all_of(points, [&](const Vec3& p) {
               return (p - points.front()).cross(along).norm() <=
                      std::max(model.tolerance, kFileAccuracy * chord.norm());
           });
}

bool turns_sharply(const Model& model, EdgeUse before, EdgeUse after)
{
    std::vector<Vec3> back = use_places(model, after);
    std::reverse(back.begin(), back.end());
    const Vec3 arrives = geometry::end_tangent(use_places(model, before)),
               leaves = -geometry::end_tangent(back);
    return geometry::angle_between(arrives, leaves) > kCreaseAngle * kDegree;
}

std::vector<std::size_t> sharp_corners(const Model& model, const Loop& loop)
{
    const std::size_t uses = loop.uses.size();
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < uses; ++i)
        if (turns_sharply(model, loop.uses[(i + uses - 1) % uses], loop.uses[i])) corners.push_back(i);
    return corners;
}

std::vector<std::vector<EdgeUse>> four_corners(const Model& model, const Loop& loop)
{
    const std::size_t uses = loop.uses.size();
    const std::vector<std::size_t> corners = sharp_corners(model, loop);
    if (corners.size() != 4) return {};
    std::vector<std::vector<EdgeUse>> sides(4);
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t i = corners[c]; i != corners[(c + 1) % 4]; i = (i + 1) % uses)
            sides[c].push_back(loop.uses[i]);
    }
    std::vector<std::vector<EdgeUse>> turned = sides;
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    return unlike(model, turned) < unlike(model, sides) ? turned : sides;
}

bool is_ruled(const Model& model, const std::vector<std::vector<EdgeUse>>& sides)
{
    return (is_straight(model, sides[0]) && is_straight(model, sides[2])) ||
           (is_straight(model, sides[1]) && is_straight(model, sides[3]));
}

} // namespace lacuna::closure
