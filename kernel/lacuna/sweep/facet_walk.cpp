// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/facet_walk.h>

#include <lacuna/mesh/incidence.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lacuna::sweep {

namespace {

/// A foot this near a side is on it, as a share of the facet's altitude; rounding is a hundred times less.
constexpr double kOnSide = 1e-12;
/// Height over longest side under which a facet has no inside to speak of: its gradients would be rounding.
constexpr double kThin = 1e-6;
/// Steps of a walk. Of points in rows the next one is one or two facets on; a choice, not a measurement.
constexpr int kMostSteps = 32;

} // namespace

std::vector<std::array<Index, 3>> facets_across(std::span<const Triangle> triangles, std::size_t point_count)
{
    const mesh::Incidence round = mesh::incidence(point_count, [&](const auto& visit) {
        for (std::size_t i = 0; i < triangles.size(); ++i)
            for (const Index corner : triangles[i]) visit(index(corner), static_cast<Index>(i));
    });
    std::vector<std::array<Index, 3>> across(triangles.size(), {-1, -1, -1});
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index from = triangles[i][k], to = triangles[i][(k + 1) % 3];
            for (const Index other : round.of(index(to))) {
                const Triangle& t = triangles[index(other)];
                const bool reversed = (t[0] == to && t[1] == from) || (t[1] == to && t[2] == from) ||
                                      (t[2] == to && t[0] == from);
                if (!reversed) continue;
                across[i][k] = other;
                break;
            }
        }
    }
    return across;
}

FacetWalk::FacetWalk(std::span<const Vec3> points, std::span<const Triangle> triangles)
    : frame_(triangles.size()), across_(facets_across(triangles, points.size()))
{
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Vec3 &a = points[index(triangles[i][0])], &b = points[index(triangles[i][1])],
                   &c = points[index(triangles[i][2])];
        const Vec3 ab = b - a, ac = c - a, area = ab.cross(ac);
        Frame& frame = frame_[i];
        frame.corner = a;
        frame.normal = area.stableNormalized();
        const double longest = std::sqrt(
            std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()}));
        const double twice = area.norm();
        if (!(twice > kThin * longest * longest)) continue;
        frame.to_first = ac.cross(frame.normal) / twice;
        frame.to_second = frame.normal.cross(ab) / twice;
        frame.altitude = {twice / (c - b).norm(), twice / ac.norm(), twice / ab.norm()};
        frame.rounding = kOnSide * longest;
    }
}

std::optional<FacetWalk::Foot> FacetWalk::over(const Vec3& point, Index start) const
{
    Index before = -1, now = start;
    for (int step = 0; step < kMostSteps && now >= 0; ++step) {
        const Frame& frame = frame_[index(now)];
        if (frame.altitude[0] == 0) return std::nullopt;
        const Vec3 from = point - frame.corner;
        Foot foot{now, {}, frame.normal.dot(from)};
        const double first = frame.to_first.dot(from), second = frame.to_second.dot(from);
        foot.barycentric = {1 - first - second, first, second};
        int lowest = 0;
        const double least = foot.barycentric.minCoeff(&lowest);
        const double height = std::abs(foot.height);
        if (least < -kOnSide) {
            const Index next = across_[index(now)][(static_cast<std::size_t>(lowest) + 1) % 3];
            if (next == before) return std::nullopt; // beside both: over the edge between them
            before = now;
            now = next;
            continue;
        }
        if (height > frame.rounding && height > foot.barycentric.cwiseProduct(frame.altitude).minCoeff())
            return std::nullopt;
        return foot;
    }
    return std::nullopt;
}

} // namespace lacuna::sweep
