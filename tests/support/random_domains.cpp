// SPDX-License-Identifier: MIT
#include "plane_domains.h"

#include "dice.h"

#include <lacuna/geometry/shared/predicates.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::test {

namespace {

constexpr double kPi = std::numbers::pi;

/// Angles of a loop's nodes, growing; neighbouring gaps may be up to a hundred times as wide as others.
std::vector<double> angles(Dice& dice, int count, double jump)
{
    std::vector<double> gaps;
    double sum = 0, gap = 1;
    for (int i = 0; i < count; ++i) {
        if (jump > 1 && dice.chance(0.1)) gap = dice.log_between(1, jump);
        gaps.push_back(gap * dice.between(0.9, 1.1));
        sum += gaps.back();
    }
    std::vector<double> result;
    double at = dice.between(0, 2 * kPi);
    for (const double g : gaps) {
        result.push_back(at);
        // No gap of half a turn: the loop goes round its centre.
        at += std::min(2 * kPi * g / sum, 0.8 * kPi);
    }
    // Gaps cut above leave the last one wider; spread what is missing.
    const double covered = at - result.front();
    for (double& angle : result) angle = result.front() + (angle - result.front()) * 2 * kPi / covered;
    return result;
}

/// A loop that its centre sees all of, within `radius` of it.
std::vector<Vec2> star_loop(Dice& dice, const Vec2& centre, double radius, int count, std::string& words)
{
    const double jump = dice.chance(0.3) ? 100 : 1;
    const double wave = dice.chance(0.5) ? dice.between(0, 0.35) : 0;
    const double spikes = dice.chance(0.3) ? dice.between(0.02, 0.3) : 0;
    const int lobes = 2 + static_cast<int>(dice.between(0, 6));
    const double phase = dice.between(0, 2 * kPi);
    words += " " + std::to_string(count) + (jump > 1 ? "j" : "") + (wave > 0 ? "w" : "") +
             (spikes > 0 ? "s" : "");
    std::vector<Vec2> points;
    for (const double angle : angles(dice, count, jump)) {
        double r = 1 - wave / 2 + wave / 2 * std::sin(lobes * angle + phase);
        if (spikes > 0 && dice.chance(spikes)) r *= dice.between(0.3, 0.8);
        points.push_back(centre + radius * r * Vec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

double distance(const Vec2& p, const Vec2& a, const Vec2& b)
{
    const Vec2 along = b - a;
    const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - a - t * along).norm();
}

/// Distance to the nearest loop; negative outside the outer one or in a hole.
double clearance(const std::vector<std::vector<Vec2>>& loops, const Vec2& p)
{
    double nearest = std::numeric_limits<double>::infinity();
    bool in = false;
    for (const auto& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
            nearest = std::min(nearest, distance(p, a, b));
        }
        if (geometry::lies_inside(loop, p)) in = !in;
    }
    return in ? nearest : -nearest;
}

int edge_count(Dice& dice, int most) { return static_cast<int>(std::lround(dice.log_between(4, most))); }

void add_holes(Dice& dice, int holes, int most, std::vector<std::vector<Vec2>>& loops, std::string& words)
{
    for (int hole = 0; hole < holes; ++hole) {
        Vec2 centre(0, 0);
        double room = -1;
        for (int attempt = 0; attempt < 30 && room < 0.05; ++attempt) {
            const double r = std::sqrt(dice.unit()), angle = dice.between(0, 2 * kPi);
            const Vec2 candidate = r * Vec2(std::cos(angle), std::sin(angle));
            const double found = clearance(loops, candidate);
            if (found > room) {
                room = found;
                centre = candidate;
            }
        }
        if (room < 0.02) return;
        // Some holes leave next to nothing between themselves and their neighbour.
        const double part = dice.chance(0.3) ? dice.between(0.97, 0.995) : dice.between(0.2, 0.8);
        std::vector<Vec2> points = star_loop(dice, centre, part * room, edge_count(dice, most), words);
        std::reverse(points.begin(), points.end());
        loops.push_back(std::move(points));
    }
}

/// No size, the same everywhere, or one that grows across the domain; never more than some ten thousand
/// quads.
std::function<double(const Vec2&)> size_for(Dice& dice, double finest,
                                            const std::vector<std::vector<Vec2>>& loops, std::string& words)
{
    std::vector<double> sides;
    for (const auto& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i)
            sides.push_back((loop[(i + 1) % loop.size()] - loop[i]).norm());
    }
    std::sort(sides.begin(), sides.end());
    const double middle = std::max(2 * finest, sides[sides.size() / 2]);
    const double kind = dice.unit();
    if (kind < 0.4) {
        words += " no size";
        return {};
    }
    if (kind < 0.7) {
        words += " size " + std::to_string(middle);
        return [middle](const Vec2&) { return middle; };
    }
    const double low = std::max(finest, middle / 3), high = low * dice.log_between(2, 100);
    words += " size " + std::to_string(low) + " to " + std::to_string(high);
    return [low, high](const Vec2& p) {
        return low * std::pow(high / low, std::clamp((p.x() + 1) / 2, 0.0, 1.0));
    };
}

} // namespace

RandomDomain random_domain(std::uint32_t seed, int most_edges)
{
    Dice dice(seed * 2654435761U + 12345U);
    RandomDomain made;
    std::vector<std::vector<Vec2>> loops;
    loops.push_back(star_loop(dice, {0, 0}, 1, edge_count(dice, most_edges), made.words));
    add_holes(dice, static_cast<int>(dice.between(0, 8)), most_edges, loops, made.words);
    const double broken = dice.unit();
    made.odd = broken < 0.03;
    made.crossed = !made.odd && broken < 0.06 && loops.front().size() > 4;

    std::size_t total = 0;
    for (const auto& loop : loops) total += loop.size();
    if ((total % 2 != 0) != made.odd) {
        auto& loop = loops[static_cast<std::size_t>(dice.unit() * static_cast<double>(loops.size()))];
        const auto at = static_cast<std::size_t>(dice.unit() * static_cast<double>(loop.size()));
        const Vec2 middle = (loop[at] + loop[(at + 1) % loop.size()]) / 2;
        loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(at) + 1, middle);
    }
    made.region.size = size_for(dice, 4.0 / std::max(40, most_edges), loops, made.words);
    if (made.crossed) std::swap(loops.front()[1], loops.front()[3]);
    for (const auto& loop : loops) {
        made.region.loops.emplace_back();
        for (const Vec2& p : loop) {
            made.region.loops.back().push_back(static_cast<Index>(made.region.points.size()));
            made.region.points.push_back(p);
        }
    }
    return made;
}

} // namespace lacuna::test
