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
/// How far a straight void edge may run from where walls lead that go all round, of the rims' radius: what is
/// lost of a section is about twice that. A choice, not a measurement.
constexpr double kAstray = 0.005;
/// The same where they are open: how they lead beside themselves is partly a guess, and where they bend
/// little a worse one than straight. A choice, not a measurement.
constexpr double kAstrayOpen = 0.25;

/// Mean distance of points from their middle; 0 for none.
double mean_radius(const std::vector<Vec3>& points)
{
    const Vec3 middle = geometry::mean_point(points);
    double sum = 0;
    for (const Vec3& p : points) sum += (p - middle).norm();
    return points.empty() ? 0 : sum / static_cast<double>(points.size());
}

/// That of a rim's points: of all loops together.
double radius_of(const topology::OpenVolume& volume, topology::Role end)
{
    const topology::Model& model = volume.model;
    std::vector<Vec3> points;
    for (const topology::Rim& rim : topology::rims(model, volume.faces(end))) {
        for (const topology::EdgeUse& use : rim.uses) {
            for (const Index p : model[use.edge].points) points.push_back(model.at(p));
        }
    }
    return mean_radius(points);
}

/// How far a point strays from a straight line.
double off_line(const Vec3& point, const Vec3& from, const Vec3& way)
{
    const Vec3 off = point - from;
    return (off - off.dot(way) * way).norm();
}

/// How far the walls' own points stray from straight lines between the rims, of their radius: half of them
/// further than this.
double bow_of(const std::vector<std::vector<Vec3>>& levels)
{
    std::vector<double> strays;
    for (std::size_t i = 0; i < levels.front().size(); ++i) {
        const Vec3 from = levels.front()[i], way = (levels.back()[i] - from).stableNormalized();
        double most = 0;
        for (const std::vector<Vec3>& level : levels) most = std::max(most, off_line(level[i], from, way));
        strays.push_back(most);
    }
    const auto middle = strays.begin() + static_cast<std::ptrdiff_t>(strays.size() / 2);
    std::nth_element(strays.begin(), middle, strays.end());
    const double radius = mean_radius(levels.front());
    return radius > 0 ? *middle / radius : 0;
}

} // namespace

Follower::Follower(const topology::OpenVolume& volume, const std::vector<matching::SideLine>& lines,
                   const RunContext& context)
{
    matching::Sections sections = matching::cut_sections(volume, lines, kLevels, context);
    heights_ = std::move(sections.heights);
    closed_ = sections.closed;
    const std::vector<std::vector<Vec3>>& levels = sections.levels;
    if (levels.front().empty()) return;
    bow_ = bow_of(levels);
    ways_.push_back(way_of(levels, sections.areas, context));
    for (const matching::LoopSections& loop : sections.loops) {
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

std::size_t Follower::walls_at(Index rim_point) const
{
    const auto found = at_rim_.find(rim_point);
    return found == at_rim_.end() ? 0 : found->second;
}

Vec3 Follower::morph(const Vec3& source, const Vec3& target, double t, std::size_t walls) const
{
    const Way& way = ways_[walls];
    const double at = std::clamp(t, 0.0, 1.0) * kLevels;
    const auto low = static_cast<std::size_t>(std::min(std::floor(at), kLevels - 1.0));
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
    return (target - ways_[0].from_target[kLevels - 1](target)).stableNormalized();
}

bool Follower::leads_astray(const topology::OpenVolume& volume, const matching::Match& match) const
{
    const topology::Model& model = volume.model;
    const std::vector<bool> on_wall = volume.on_wall();
    if (closed_ && !(bow_ > kAstray)) return false;
    const double reach = (closed_ ? kAstray : kAstrayOpen) *
                         std::min(radius_of(volume, topology::Role::source),
                                  radius_of(volume, topology::Role::target));
    for (const auto& [source, target] : match.vertices) {
        if (on_wall[source.index()] || on_wall[target.index()]) continue;
        const Vec3 from = model.at(model[source].point), to = model.at(model[target].point);
        const Vec3 way = (to - from).stableNormalized();
        for (int k = 1; k < kLevels; ++k) {
            if (off_line(morph(from, to, static_cast<double>(k) / kLevels), from, way) > reach) return true;
        }
    }
    return false;
}

} // namespace lacuna::closure
