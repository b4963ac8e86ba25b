// SPDX-License-Identifier: MIT
#include <lacuna/closure/shared/follow.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/facet_tree.h>
#include <lacuna/matching/shared/guides.h>
#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

namespace {

/// Void edges beside walls that form no ring are straight if the bow of the walls (`Follower::bow()`) is at
/// most this. Beside a ring the limit is half of `kSameVolume`, because straight void edges change the area
/// of the section by about twice the bow. It is higher here, because walls with a given mesh and single
/// twisted walls with few facets may have such a bow although the true wall is straight.
constexpr double kAstrayOpen = 0.04;

/// Mean distance of points from their centroid; 0 if there are none.
double mean_radius(const std::vector<Vec3>& points)
{
    const Vec3 middle = geometry::mean_point(points);
    double sum = 0;
    for (const Vec3& p : points) sum += (p - middle).norm();
    return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

/// The upper median of some numbers. @pre not empty
double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// See `Follower::bow()`.
/// @param levels  points of the sections, from the source to the target.
double bow_of(const std::vector<std::vector<Vec3>>& levels)
{
    constexpr double kOnePart = 4; // in mean steps: points that are further apart belong to different parts
    const std::size_t n = levels.front().size();
    std::vector<Vec3> points = levels.front();
    points.insert(points.end(), levels.back().begin(), levels.back().end());
    double step = 0;
    for (std::size_t i = 0; i + 1 < n; ++i)
        step += (points[i + 1] - points[i]).norm() / static_cast<double>(n);
    std::vector<Triangle> strip;
    for (std::size_t i = 0; i + 1 < n; ++i) {
        if ((points[i + 1] - points[i]).norm() > kOnePart * step) continue;
        const auto a = static_cast<Index>(i), b = static_cast<Index>(n + i);
        strip.push_back({a, a + 1, b + 1});
        strip.push_back({a, b + 1, b});
    }
    if (strip.empty()) return 0;
    const geometry::FacetTree tree(points, strip);
    std::vector<double> strays(n, 0.0); // squared
    for (std::size_t k = 1; k + 1 < levels.size(); ++k) {
        for (std::size_t i = 0; i < n; ++i)
            strays[i] = std::max(strays[i], tree.closest(levels[k][i]).distance2);
    }
    const double radius = mean_radius(levels.front());
    return radius > 0 ? std::sqrt(median(std::move(strays))) / radius : 0;
}

} // namespace

Follower::Follower(const topology::OpenVolume& volume, const std::vector<matching::SideLine>& lines,
                   const RunContext& context)
{
    matching::Sections sections = matching::cut_sections(volume, lines, context);
    heights_ = std::move(sections.heights);
    closed_ = sections.closed;
    const std::vector<std::vector<Vec3>>& levels = sections.levels;
    if (levels.front().empty()) return;
    bow_ = bow_of(levels);
    ways_.push_back(way_of(levels, sections.areas, context));
    for (const matching::LoopSections& loop : sections.loops) {
        // Within the limit, the rings represent the bend of the other loops better. On 350 bent, twisted and
        // tapered tubes, nine of ten loops missed by less than half of it; on a lofted pipe, one by 0.017.
        if (!closed_ || !(missed_by_all(volume.model, loop) > kAlikeSizes)) continue;
        for (const Index point : loop.rim) at_rim_.emplace(point, ways_.size());
        ways_.push_back(way_of(loop.levels, sections.areas, context));
    }
}

Follower::Way Follower::way_of(const std::vector<std::vector<Vec3>>& levels, const std::vector<Vec3>& areas,
                               const RunContext& context)
{
    Way way;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        check_cancelled(context);
        way.from_source.push_back(geometry::fit_affine(levels.front(), levels[k], areas.front(), areas[k]));
        way.from_target.push_back(geometry::fit_affine(levels.back(), levels[k], areas.back(), areas[k]));
    }
    return way;
}

double Follower::missed_by_all(const topology::Model& model, const matching::LoopSections& loop) const
{
    const geometry::FacetTree tree(model.points, topology::facets_of(model, loop.faces));
    std::vector<double> missed;
    for (std::size_t k = 1; k + 1 < loop.levels.size(); ++k) {
        const double t = static_cast<double>(k) / kFineChords;
        for (std::size_t i = 0; i < loop.levels[k].size(); ++i)
            missed.push_back(
                std::sqrt(tree.closest(morph(loop.levels.front()[i], loop.levels.back()[i], t)).distance2));
    }
    const double radius = mean_radius(loop.levels.front());
    return radius > 0 ? median(std::move(missed)) / radius : 0;
}

std::size_t Follower::walls_at(Index rim_point) const
{
    const auto found = at_rim_.find(rim_point);
    return found == at_rim_.end() ? 0 : found->second;
}

Vec3 Follower::morph(const Vec3& source, const Vec3& target, double t, std::size_t walls) const
{
    const Way& way = ways_[walls];
    const double at = std::clamp(t, 0.0, 1.0) * kFineChords;
    const auto low = static_cast<std::size_t>(std::min(std::floor(at), kFineChords - 1.0));
    const double f = at - static_cast<double>(low);
    const Vec3 up = (1 - f) * way.from_source[low](source) + f * way.from_source[low + 1](source);
    const Vec3 down = (1 - f) * way.from_target[low](target) + f * way.from_target[low + 1](target);
    return (1 - t) * up + t * down;
}

Vec3 Follower::leaving(const Vec3& source) const
{
    return (ways_[0].from_source[1](source) - source).stableNormalized();
}

Vec3 Follower::arriving(const Vec3& target) const
{
    return (target - ways_[0].from_target[kFineChords - 1](target)).stableNormalized();
}

bool Follower::leads_astray() const { return bow_ > (closed_ ? kSameVolume / 2 : kAstrayOpen); }

} // namespace lacuna::closure
