// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/facet_walk.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/mesh/shared/incidence.h>

#include <algorithm>
#include <cmath>

namespace lacuna::sweep {

FacetWalk::FacetWalk(std::span<const Vec3> points, std::span<const Triangle> triangles)
    : frame_(triangles.size()), across_(triangles.size(), {-1, -1, -1})
{
    const mesh::Incidence round = mesh::incidence(points.size(), [&](const auto& visit) {
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (const Index corner : triangles[i]) visit(index(corner), static_cast<Index>(i));
    });
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index from = triangles[i][k], to = triangles[i][(k + 1) % 3];
            const auto at_from = round.of(index(from)), at_to = round.of(index(to));
            for (const Index other : at_from.size() < at_to.size() ? at_from : at_to) {
                const Triangle& t = triangles[index(other)];
                const bool reversed = (t[0] == to && t[1] == from) || (t[1] == to && t[2] == from) ||
                                      (t[2] == to && t[0] == from);
                if (!reversed) continue;
                across_[i][k] = other;
                break;
            }
        }
        set_frame(i, {points[index(triangles[i][0])], points[index(triangles[i][1])],
                      points[index(triangles[i][2])]});
    }
}

void FacetWalk::set_frame(std::size_t facet, const std::array<Vec3, 3>& c)
{
    const Vec3 ab = c[1] - c[0], ac = c[2] - c[0], area = ab.cross(ac);
    Frame& frame = frame_[facet];
    frame.corner = c[0];
    frame.normal = area.stableNormalized();
    const double longest = std::sqrt(
        std::max({ab.squaredNorm(), ac.squaredNorm(), (c[2] - c[1]).squaredNorm()}));
    const double twice = area.norm();
    if (!(twice > kFileAccuracy * longest * longest)) return;
    frame.to_first = ac.cross(frame.normal) / twice;
    frame.to_second = frame.normal.cross(ab) / twice;
    frame.altitude = {twice / (c[2] - c[1]).norm(), twice / ac.norm(), twice / ab.norm()};
    frame.rounding = kRoundoff * longest;
}

std::optional<FacetWalk::Foot> FacetWalk::over(const Vec3& point, Index start) const
{
    Index before = -1, now = start;
    // For points in rows, the next facet is one or two steps away.
    for (int step = 0; step < kMostRounds && now >= 0; ++step) {
        const Frame& frame = frame_[index(now)];
        if (frame.altitude[0] == 0) return std::nullopt;
        const Vec3 from = point - frame.corner;
        Foot foot;
        foot.facet = now;
        foot.height = frame.normal.dot(from);
        const double first = frame.to_first.dot(from), second = frame.to_second.dot(from);
        foot.barycentric = {1 - first - second, first, second};
        int lowest = 0;
        const double least = foot.barycentric.minCoeff(&lowest);
        const double height = std::abs(foot.height);
        if (least < -kRoundoff) {
            const Index next = across_[index(now)][(static_cast<std::size_t>(lowest) + 1) % 3];
            // The point lies beyond the common side of both facets, so it is above the edge between them.
            if (next == before) return std::nullopt;
            before = now;
            now = next;
            continue;
        }
        const double clear = foot.barycentric.cwiseProduct(frame.altitude).minCoeff();
        foot.nearest = height <= std::max(clear, frame.rounding);
        return foot;
    }
    return std::nullopt;
}

} // namespace lacuna::sweep
