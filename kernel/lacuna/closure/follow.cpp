// SPDX-License-Identifier: MIT
#include <lacuna/closure/follow.h>

#include <lacuna/matching/guides.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

namespace {

constexpr int kLevels = 64;

} // namespace

Follower::Follower(const topology::OpenVolume& volume)
{
    matching::Sections sections = matching::cut_sections(volume, kLevels);
    heights_ = std::move(sections.heights);
    const std::vector<std::vector<Vec3>>& levels = sections.levels;
    if (levels.front().empty()) return;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        from_source_.push_back(
            geometry::fit_affine(levels.front(), levels[k], sections.areas.front(), sections.areas[k]));
        from_target_.push_back(
            geometry::fit_affine(levels.back(), levels[k], sections.areas.back(), sections.areas[k]));
    }
}

Vec3 Follower::carry(const Vec3& source, const Vec3& target, double t) const
{
    const double at = std::clamp(t, 0.0, 1.0) * kLevels;
    const auto low = static_cast<std::size_t>(std::min(std::floor(at), kLevels - 1.0));
    const double f = at - static_cast<double>(low);
    const Vec3 up = (1 - f) * from_source_[low](source) + f * from_source_[low + 1](source);
    const Vec3 down = (1 - f) * from_target_[low](target) + f * from_target_[low + 1](target);
    return (1 - t) * up + t * down;
}

} // namespace lacuna::closure
