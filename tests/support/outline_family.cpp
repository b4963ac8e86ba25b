// SPDX-License-Identifier: MIT
#include "outline_family.h"

#include "dice.h"

#include <lacuna/geometry/shared/triangulate.h>

#include <algorithm>
#include <numbers>

namespace lacuna::test {

namespace {

constexpr double kPi = std::numbers::pi;
using Loop = std::vector<PlaneCurve>;

Vec2 on_circle(const Vec2& centre, double radius, double angle)
{
    return centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

PlaneCurve line(const Vec2& from, const Vec2& to)
{
    return {PlaneCurve::Kind::line, from, to, {0, 0}, false, {}};
}

PlaneCurve arc(const Vec2& centre, const Vec2& from, const Vec2& to, bool clockwise)
{
    return {PlaneCurve::Kind::arc, from, to, centre, clockwise, {}};
}

Loop polygon(const std::vector<Vec2>& corners)
{
    Loop loop;
    for (std::size_t i = 0; i < corners.size(); ++i)
        loop.push_back(line(corners[i], corners[(i + 1) % corners.size()]));
    return loop;
}

Loop circle(const Vec2& centre, double radius, bool hole)
{
    Loop loop;
    for (int i = 0; i < 4; ++i) {
        const double way = hole ? -1 : 1;
        loop.push_back(arc(centre, on_circle(centre, radius, way * i * kPi / 2),
                           on_circle(centre, radius, way * (i + 1) * kPi / 2), hole));
    }
    return loop;
}

/// Two half circles and two lines, clockwise.
Loop slot(const Vec2& centre, double length, double radius, double angle)
{
    const Vec2 u = length / 2 * on_circle({0, 0}, 1, angle),
               v = radius * on_circle({0, 0}, 1, angle + kPi / 2);
    const Vec2 r = radius * on_circle({0, 0}, 1, angle);
    return {line(centre - u + v, centre + u + v),
            arc(centre + u, centre + u + v, centre + u + r, true),
            arc(centre + u, centre + u + r, centre + u - v, true),
            line(centre + u - v, centre - u - v),
            arc(centre - u, centre - u - v, centre - u - r, true),
            arc(centre - u, centre - u - r, centre - u + v, true)};
}

/// Corners on an ellipse, at least a share of an even step apart.
std::vector<Vec2> convex_corners(Dice& dice, int count, double radius)
{
    std::vector<double> at{0};
    for (int i = 0; i < count; ++i) at.push_back(at.back() + dice.between(0.6, 1.4));
    const double flat = dice.between(0.6, 1);
    std::vector<Vec2> corners;
    for (int i = 0; i < count; ++i) {
        const Vec2 p = on_circle({0, 0}, radius, 2 * kPi * at[static_cast<std::size_t>(i)] / at.back());
        corners.emplace_back(p.x(), flat * p.y());
    }
    return corners;
}

/// A polygon whose corners are sharp, rounded, or hollowed by an arc about them.
Loop rounded_polygon(Dice& dice)
{
    const std::vector<Vec2> corners = convex_corners(dice, dice.whole(3, 8), 1);
    const std::size_t n = corners.size();
    std::vector<Vec2> start(n), end(n);
    std::vector<int> kind(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 p = corners[i], before = corners[(i + n - 1) % n] - p, after = corners[(i + 1) % n] - p;
        kind[i] = dice.whole(0, 2);
        const double cut = kind[i] == 0 ? 0 : dice.between(0.15, 0.4) * std::min(before.norm(), after.norm());
        start[i] = p + cut * before.normalized();
        end[i] = p + cut * after.normalized();
    }
    Loop loop;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2& p = corners[i];
        if (kind[i] == 1) {
            const Vec2 in = (start[i] - p).normalized();
            const double half = std::acos(std::clamp(in.dot((end[i] - p).normalized()), -1.0, 1.0)) / 2;
            const Vec2 middle = ((start[i] + end[i]) / 2 - p).normalized();
            loop.push_back(arc(p + (start[i] - p).norm() / std::cos(half) * middle, start[i], end[i], false));
        } else if (kind[i] == 2) {
            loop.push_back(arc(p, start[i], end[i], true));
        }
        loop.push_back(line(end[i], start[(i + 1) % n]));
    }
    return loop;
}

Loop stepped_shape(Dice& dice)
{
    const double w = dice.between(0.25, 0.6), h = dice.between(0.25, 0.6), l = dice.between(0.8, 1.6);
    const double a = dice.between(0.1, 0.9 - w);
    switch (dice.whole(0, 3)) {
    case 0: // L
        return polygon({{0, 0}, {l, 0}, {l, h}, {w, h}, {w, 1}, {0, 1}});
    case 1: // T
        return polygon({{0, 0}, {1, 0}, {1, h}, {a + w, h}, {a + w, h + l}, {a, h + l}, {a, h}, {0, h}});
    case 2: // U
        return polygon({{0, 0},
                        {1, 0},
                        {1, h + l},
                        {a + w, h + l},
                        {a + w, h},
                        {a, h},
                        {a, h + 0.7 * l},
                        {0, h + 0.7 * l}});
    default: // plus
        return polygon({{a, 0},
                        {a + w, 0},
                        {a + w, h},
                        {1, h},
                        {1, h + w},
                        {a + w, h + w},
                        {a + w, h + l},
                        {a, h + l},
                        {a, h + w},
                        {0, h + w},
                        {0, h},
                        {a, h}});
    }
}

/// Round holes or slots in a box, each in a cell of its own.
PlaneDomain plate(Dice& dice, bool slots)
{
    const int columns = dice.whole(1, 3), rows = dice.whole(1, 2);
    PlaneDomain domain{slots ? "slotted plate" : "plate", {}, {}};
    const double wide = columns, high = rows * dice.between(0.8, 1.2);
    domain.loops.push_back(polygon({{0, 0}, {wide, 0}, {wide, high}, {0, high}}));
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            if (i + j > 0 && dice.chance(0.3)) continue;
            const double cell = high / rows, radius = dice.between(0.12, slots ? 0.18 : 0.32);
            const Vec2 centre(i + 0.5 + dice.between(-0.08, 0.08),
                              (j + 0.5 + dice.between(-0.08, 0.08)) * cell);
            domain.loops.push_back(slots ? slot(centre, dice.between(0.2, 0.4), radius, dice.between(0, kPi))
                                         : circle(centre, radius, true));
        }
    }
    return domain;
}

PlaneDomain gear(Dice& dice)
{
    const int teeth = dice.whole(6, 20);
    const double root = dice.between(0.75, 0.88), pitch = 2 * kPi / teeth, slope = dice.between(0.05, 0.18);
    Loop rim;
    for (int tooth = 0; tooth < teeth; ++tooth) {
        const double at = tooth * pitch;
        const Vec2 a = on_circle({0, 0}, root, at), b = on_circle({0, 0}, root, at + 0.45 * pitch);
        const Vec2 c = on_circle({0, 0}, 1, at + (0.45 + slope) * pitch),
                   d = on_circle({0, 0}, 1, at + (1 - slope) * pitch),
                   e = on_circle({0, 0}, root, at + pitch);
        rim.insert(rim.end(), {arc({0, 0}, a, b, false), line(b, c), arc({0, 0}, c, d, false), line(d, e)});
    }
    // The last tooth ends in the first's start, to the bit.
    rim.back().to = rim.front().from;
    return {"gear", {rim, circle({0, 0}, dice.between(0.2, 0.55), true)}, {}};
}

PlaneDomain smooth_loop(Dice& dice)
{
    std::array<double, 4> size{}, phase{};
    for (std::size_t k = 0; k < 4; ++k) {
        size[k] = dice.between(0, 0.22) / static_cast<double>(k + 1);
        phase[k] = dice.between(0, 2 * kPi);
    }
    std::vector<Vec2> points;
    constexpr int kPoints = 800;
    for (int i = 0; i <= kPoints; ++i) {
        const double angle = 2 * kPi * (i % kPoints) / kPoints;
        double radius = 1;
        for (std::size_t k = 0; k < 4; ++k)
            radius += size[k] * std::cos(static_cast<double>(k + 1) * angle + phase[k]);
        points.push_back(on_circle({0, 0}, radius, angle));
    }
    PlaneDomain domain{"smooth loop",
                       {{{PlaneCurve::Kind::free, points.front(), points.back(), {0, 0}, false, points}}},
                       {}};
    if (dice.chance(0.5)) domain.loops.push_back(circle({0, 0}, dice.between(0.15, 0.3), true));
    return domain;
}

PlaneDomain ring(Dice& dice)
{
    PlaneDomain domain{"ring", {circle({0, 0}, 1, false)}, {}};
    const double bore = dice.between(0.15, 0.35);
    domain.loops.push_back(
        circle(on_circle({0, 0}, dice.between(0, 0.12), dice.between(0, 2 * kPi)), bore, true));
    const int bolts = dice.whole(0, 5);
    for (int i = 0; i < bolts; ++i)
        domain.loops.push_back(
            circle(on_circle({0, 0}, 0.72, 2 * kPi * i / bolts), dice.between(0.08, 0.15), true));
    return domain;
}

PlaneDomain holed_polygon(Dice& dice)
{
    PlaneDomain domain{"holed polygon", {polygon(convex_corners(dice, dice.whole(4, 9), 1))}, {}};
    std::vector<Vec2> hole = convex_corners(dice, dice.whole(3, 6), dice.between(0.12, 0.3));
    std::reverse(hole.begin(), hole.end());
    domain.loops.push_back(polygon(hole));
    return domain;
}

PlaneDomain unturned(Dice& dice, int kind)
{
    switch (kind) {
    case 0:
        return {"rounded polygon", {rounded_polygon(dice)}, {}};
    case 1:
        return {"stepped shape", {stepped_shape(dice)}, {}};
    case 2:
    case 3:
        return plate(dice, kind == 3);
    case 4:
        return gear(dice);
    case 5:
        return smooth_loop(dice);
    case 6:
        return ring(dice);
    default:
        return holed_polygon(dice);
    }
}

/// A generator for one member, and its first numbers thrown away: seeds nearby begin alike.
Dice dice_of(std::uint32_t seed, int number)
{
    Dice dice(seed * 2654435761U + static_cast<std::uint32_t>(number) * 40503U + 977U);
    for (int i = 0; i < 8; ++i) dice.unit();
    return dice;
}

} // namespace

PlaneDomain family_domain(std::uint32_t seed, int number)
{
    constexpr int kKinds = 8;
    Dice dice = dice_of(seed, number);
    PlaneDomain domain = unturned(dice, number % kKinds);
    const Eigen::Rotation2Dd turn(dice.between(0, 2 * kPi));
    for (Loop& loop : domain.loops) {
        for (PlaneCurve& curve : loop) {
            for (Vec2* p : {&curve.from, &curve.to, &curve.centre}) *p = turn * *p;
            for (Vec2& p : curve.through) p = turn * p;
        }
    }
    return domain;
}

SeededDomain family_region(std::uint32_t seed, int number)
{
    // Coarse seeds may make loops touch: then finer ones.
    double quads = dice_of(~seed, number).log_between(100, 1500);
    SeededDomain seeded = seed_domain(family_domain(seed, number), quads);
    while (geometry::find_crossing(seeded.region.points, seeded.region.loops)) {
        quads *= 2;
        seeded = seed_domain(family_domain(seed, number), quads);
    }
    return seeded;
}

} // namespace lacuna::test
