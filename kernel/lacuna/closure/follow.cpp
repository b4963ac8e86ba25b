// SPDX-License-Identifier: MIT
#include <lacuna/closure/follow.h>

#include <lacuna/matching/guides.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

namespace {

/// Heights at which the walls are cut: as many as a void edge has segments, so that each gets a level of
/// its own.
constexpr int kLevels = 64;
/// How far a straight void edge may run from where the walls lead, of the rims' radius.
/// A choice, not a measurement.
constexpr double kAstray = 0.25;

/// Mean distance of a rim's vertices from their middle: of all loops together.
double radius_of(const topology::OpenVolume& volume, topology::Role end)
{
    const topology::Model& model = volume.model;
    std::vector<Vec3> points;
    for (const topology::Rim& rim : topology::rims(model, volume.faces(end))) {
        for (const topology::EdgeUse& use : rim.uses) {
            for (const Index p : model[use.edge].points) points.push_back(model.at(p));
        }
    }
    const Vec3 middle = geometry::mean_point(points);
    double sum = 0;
    for (const Vec3& p : points) sum += (p - middle).norm();
    return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

} // namespace

Follower::Follower(const topology::OpenVolume& volume, const std::vector<matching::SideLine>& lines,
                   const RunContext& context)
{
    matching::Sections sections = matching::cut_sections(volume, lines, kLevels, context);
    heights_ = std::move(sections.heights);
    const std::vector<std::vector<Vec3>>& levels = sections.levels;
    if (levels.front().empty()) return;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        check_cancelled(context);
        from_source_.push_back(
            geometry::fit_affine(levels.front(), levels[k], sections.areas.front(), sections.areas[k]));
        from_target_.push_back(
            geometry::fit_affine(levels.back(), levels[k], sections.areas.back(), sections.areas[k]));
    }
}

Vec3 Follower::morph(const Vec3& source, const Vec3& target, double t) const
{
    const double at = std::clamp(t, 0.0, 1.0) * kLevels;
    const auto low = static_cast<std::size_t>(std::min(std::floor(at), kLevels - 1.0));
    const double f = at - static_cast<double>(low);
    const Vec3 up = (1 - f) * from_source_[low](source) + f * from_source_[low + 1](source);
    const Vec3 down = (1 - f) * from_target_[low](target) + f * from_target_[low + 1](target);
    return (1 - t) * up + t * down;
}

Vec3 Follower::leaving(const Vec3& source) const
{
    return (from_source_[1](source) - source).stableNormalized();
}

Vec3 Follower::arriving(const Vec3& target) const
{
    return (target - from_target_[kLevels - 1](target)).stableNormalized();
}

bool Follower::leads_astray(const topology::OpenVolume& volume, const matching::Match& match) const
{
    const topology::Model& model = volume.model;
    const std::vector<bool> on_wall = volume.on_wall();
    const double reach = kAstray * std::min(radius_of(volume, topology::Role::source),
                                            radius_of(volume, topology::Role::target));
    for (const auto& [source, target] : match.vertices) {
        if (on_wall[source.index()] || on_wall[target.index()]) continue;
        const Vec3 from = model.at(model[source].point), to = model.at(model[target].point);
        const Vec3 way = (to - from).stableNormalized();
        for (int k = 1; k < kLevels; ++k) {
            const Vec3 off = morph(from, to, static_cast<double>(k) / kLevels) - from;
            if ((off - off.dot(way) * way).norm() > reach) return true;
        }
    }
    return false;
}

} // namespace lacuna::closure
