// SPDX-License-Identifier: MIT
#include <lacuna/quads/detail/region_loops.h>

#include <algorithm>
#include <lacuna/core/shared/renumbered.h>

namespace lacuna::quads {

Vec2 point_along(std::span<const Vec2> points, const Cycle& loop, std::size_t from, double sides)
{
    const auto whole = static_cast<std::size_t>(sides);
    const double part = sides - static_cast<double>(whole);
    return (1 - part) * point_of(points, loop, from + whole) +
           part * point_of(points, loop, from + whole + 1);
}

void add_divided(std::span<const Vec2> points, const Cycle& loop, std::size_t from, std::size_t to, int sides,
                 std::vector<Vec2>& divided)
{
    for (int k = 0; k < sides; ++k)
        divided.push_back(
            point_along(points, loop, from, static_cast<double>(k) / sides * static_cast<double>(to - from)));
}

std::vector<Vec2> points_between(const Vec2& a, const Vec2& b, std::size_t sides, const SizeField& size)
{
    // The points divide the integral of 1 / size along the line into equal parts. The integral is sampled.
    const std::size_t samples = std::max<std::size_t>(2 * sides, 16);
    std::vector<double> sum(samples + 1, 0);
    for (std::size_t k = 0; k < samples; ++k) {
        const double f = (static_cast<double>(k) + 0.5) / static_cast<double>(samples);
        sum[k + 1] = sum[k] + 1 / size((1 - f) * a + f * b);
    }
    std::vector<Vec2> points;
    std::size_t k = 0;
    for (std::size_t i = 1; i < sides; ++i) {
        const double goal = sum.back() * static_cast<double>(i) / static_cast<double>(sides);
        while (sum[k + 1] < goal) ++k;
        const double f = (static_cast<double>(k) + (goal - sum[k]) / (sum[k + 1] - sum[k])) /
                         static_cast<double>(samples);
        points.push_back((1 - f) * a + f * b);
    }
    return points;
}

double corner_angle(std::span<const Vec2> points, const Cycle& loop, std::size_t place)
{
    const Vec2& p = point_of(points, loop, place);
    return turn_between(point_of(points, loop, place + 1) - p,
                        point_of(points, loop, place + loop.size() - 1) - p);
}

std::vector<double> corner_angles(std::span<const Vec2> points, const Cycle& loop)
{
    std::vector<double> angles(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) angles[i] = corner_angle(points, loop, i);
    return angles;
}

double twice_area(std::span<const Vec2> points, const Cycle& loop)
{
    const Vec2& origin = points[index(loop.front())];
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += cross(point_of(points, loop, i) - origin, point_of(points, loop, i + 1) - origin);
    return sum;
}

Vec2 point_above(std::span<const Vec2> points, const Cycle& loop, std::size_t place, const SizeField& height)
{
    const Vec2& here = point_of(points, loop, place);
    const Vec2 along = (point_of(points, loop, place + 1) - here).normalized() +
                       (here - point_of(points, loop, place + loop.size() - 1)).normalized();
    const double length = along.norm();
    const Vec2 unit = length > 0 ? Vec2(along / length) : Vec2(1, 0);
    return here + height(here) * Vec2(-unit.y(), unit.x());
}

RegionWithin region_within(std::span<const Vec2> points, const std::vector<Cycle>& loops,
                           const SizeField& size)
{
    RegionWithin made{{{}, {}, size}, {}};
    for (const Cycle& loop : loops) {
        Cycle& local = made.region.loops.emplace_back();
        for (const Index p : loop) {
            local.push_back(static_cast<Index>(made.own.size()));
            made.region.points.push_back(points[index(p)]);
            made.own.push_back(p);
        }
    }
    return made;
}

void add_filling(std::vector<Vec2>& points, std::vector<Quad>& quads, const std::vector<Index>& own,
                 std::span<const Vec2> inner, std::span<const Quad> filling)
{
    const auto rim = static_cast<Index>(own.size()), shift = static_cast<Index>(points.size()) - rim;
    points.insert(points.end(), inner.begin(), inner.end());
    for (Quad quad : filling) {
        for (Index& p : quad) p = p < rim ? own[index(p)] : p + shift;
        quads.push_back(quad);
    }
}

void add_filling(PlanarQuads& mesh, const std::vector<Index>& own, const PlanarQuads& filling)
{
    const std::span<const Vec2> all = filling.points; // empty if there is no filling
    add_filling(mesh.points, mesh.quads, own, all.subspan(std::min(own.size(), all.size())), filling.quads);
}

void drop_loose_points(PlanarQuads& mesh, std::size_t fixed)
{
    Renumbered number(mesh.points);
    for (std::size_t p = 0; p < fixed; ++p) number(p);
    for (Quad& quad : mesh.quads)
        for (Index& p : quad) p = number(p);
    mesh.points = std::move(number.used);
}

} // namespace lacuna::quads
