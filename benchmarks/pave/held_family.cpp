// SPDX-License-Identifier: MIT
#include "held_family.h"

#include "support/dice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace lacuna::bench {

namespace {

using test::Dice;
using test::PlaneCurve;
using Loop = std::vector<PlaneCurve>;

constexpr double kPi = std::numbers::pi;
constexpr int kCells = 3; ///< columns and rows

PlaneCurve line(const Vec2& from, const Vec2& to)
{
    return {PlaneCurve::Kind::line, from, to, {0, 0}, false, {}};
}

PlaneCurve arc(const Vec2& centre, const Vec2& from, const Vec2& to, bool clockwise)
{
    return {PlaneCurve::Kind::arc, from, to, centre, clockwise, {}};
}

Vec2 on_circle(const Vec2& centre, double radius, double angle)
{
    return centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

struct Grid {
    std::array<double, kCells + 1> x{}, y{};
    std::array<std::array<bool, kCells>, kCells> full{}; ///< by column and row

    [[nodiscard]] bool has(int i, int j) const
    {
        return i >= 0 && j >= 0 && i < kCells && j < kCells &&
               full[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    [[nodiscard]] Vec2 at(int i, int j) const
    {
        return {x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)]};
    }
};

Grid cells_of(Dice& dice)
{
    Grid grid;
    for (std::size_t k = 1; k <= kCells; ++k) {
        grid.x[k] = grid.x[k - 1] + dice.between(0.6, 1.5);
        grid.y[k] = grid.y[k - 1] + dice.between(0.6, 1.5);
    }
    int i = dice.whole(0, kCells - 1), j = dice.whole(0, kCells - 1);
    const int steps = dice.whole(0, 7);
    grid.full[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = true;
    for (int step = 0; step < steps; ++step) {
        (dice.chance(0.5) ? i : j) += dice.chance(0.5) ? 1 : -1;
        i = std::clamp(i, 0, kCells - 1);
        j = std::clamp(j, 0, kCells - 1);
        grid.full[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = true;
    }
    // Cells that meet in a corner alone would pinch the outline, and a cell left out within is a hole.
    for (bool more = true; more;) {
        more = false;
        for (int a = 0; a < kCells; ++a) {
            for (int b = 0; b < kCells; ++b) {
                if (grid.has(a, b)) continue;
                const bool held = (grid.has(a - 1, b) && grid.has(a + 1, b)) &&
                                  (grid.has(a, b - 1) && grid.has(a, b + 1));
                bool pinched = false;
                for (const int u : {-1, 1}) {
                    for (const int v : {-1, 1})
                        pinched = pinched ||
                                  (grid.has(a + u, b) && grid.has(a, b + v) && !grid.has(a + u, b + v));
                }
                if (!held && !pinched) continue;
                grid.full[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = more = true;
            }
        }
    }
    return grid;
}

/// The corners around all full cells, counter-clockwise.
std::vector<Vec2> outline_of(const Grid& grid)
{
    // Sides with the cells on their left; walked, always turning right first, from the lowest one.
    constexpr std::array<std::array<int, 2>, 4> kWay{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto is_side = [&](int i, int j, int way) {
        const std::array<std::array<int, 2>, 4> left{{{0, 0}, {-1, 0}, {-1, -1}, {0, -1}}},
            right{{{0, -1}, {0, 0}, {-1, 0}, {-1, -1}}};
        const auto w = static_cast<std::size_t>(way);
        return grid.has(i + left[w][0], j + left[w][1]) && !grid.has(i + right[w][0], j + right[w][1]);
    };
    int i = 0, j = 0;
    while (!is_side(i, j, 0)) {
        if (++i < kCells) continue;
        i = 0;
        ++j;
    }
    const int first_i = i, first_j = j;
    std::vector<Vec2> corners;
    int way = 0, before = -1;
    do {
        if (way != before) corners.push_back(grid.at(i, j));
        before = way;
        i += kWay[static_cast<std::size_t>(way)][0];
        j += kWay[static_cast<std::size_t>(way)][1];
        for (const int turn : {3, 0, 1}) {
            if (!is_side(i, j, (before + turn) % 4)) continue;
            way = (before + turn) % 4;
            break;
        }
    } while (i != first_i || j != first_j);
    return corners;
}

/// A line with a notch cut into its middle, or without.
void add_side(Dice& dice, const Vec2& from, const Vec2& to, Loop& loop)
{
    const double length = (to - from).norm();
    const int kind = dice.chance(0.25) && length > 0.5 ? dice.whole(0, 2) : 3;
    if (kind == 3) {
        loop.push_back(line(from, to));
        return;
    }
    const Vec2 along = (to - from) / length, inward(-along.y(), along.x());
    const double half = dice.between(0.06, 0.12), deep = dice.between(0.08, 0.2);
    const Vec2 middle = from + dice.between(0.4, 0.6) * (to - from);
    const Vec2 a = middle - half * along, b = middle + half * along;
    loop.push_back(line(from, a));
    if (kind == 0) { // square
        loop.push_back(line(a, a + deep * inward));
        loop.push_back(line(a + deep * inward, b + deep * inward));
        loop.push_back(line(b + deep * inward, b));
    } else if (kind == 1) { // pointed
        loop.push_back(line(a, middle + deep * inward));
        loop.push_back(line(middle + deep * inward, b));
    } else {
        loop.push_back(arc(middle, a, middle + half * inward, true));
        loop.push_back(arc(middle, middle + half * inward, b, true));
    }
    loop.push_back(line(b, to));
}

Loop rim_of(Dice& dice, const std::vector<Vec2>& corners)
{
    const std::size_t n = corners.size();
    std::vector<Vec2> start(n), end(n);
    std::vector<int> kind(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 before = corners[(i + n - 1) % n] - corners[i], after = corners[(i + 1) % n] - corners[i];
        kind[i] = dice.whole(0, 3); // two kinds of four are sharp
        const double shortest = std::min(before.norm(), after.norm());
        const double cut = kind[i] < 2 ? dice.between(0.08, 0.3) * shortest : 0;
        start[i] = corners[i] + cut * before.normalized();
        end[i] = corners[i] + cut * after.normalized();
    }
    Loop loop;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 in = corners[i] - start[i], out = end[i] - corners[i];
        if (kind[i] == 0) loop.push_back(line(start[i], end[i]));
        if (kind[i] == 1) // a quarter circle; the corners are right
            loop.push_back(arc(start[i] + out, start[i], end[i], in.x() * out.y() - in.y() * out.x() < 0));
        add_side(dice, end[i], start[(i + 1) % n], loop);
    }
    return loop;
}

Loop hole_in(Dice& dice, const Vec2& low, const Vec2& high)
{
    const double room = std::min(high.x() - low.x(), high.y() - low.y());
    const Vec2 centre = (low + high) / 2 + 0.05 * room * Vec2(dice.between(-1, 1), dice.between(-1, 1));
    const double radius = dice.between(0.12, 0.24) * room, turn = dice.between(0, kPi);
    Loop loop;
    const int kind = dice.whole(0, 3);
    if (kind == 2) { // hexagonal
        for (int k = 0; k < 6; ++k)
            loop.push_back(line(on_circle(centre, radius, turn - k * kPi / 3),
                                on_circle(centre, radius, turn - (k + 1) * kPi / 3)));
        loop.back().to = loop.front().from;
    } else if (kind == 3) { // a slot
        const double thin = 0.6 * radius;
        const Vec2 u = 0.7 * radius * on_circle({0, 0}, 1, turn),
                   v = thin * on_circle({0, 0}, 1, turn + kPi / 2);
        const Vec2 tip = thin * on_circle({0, 0}, 1, turn);
        loop = {line(centre - u + v, centre + u + v),
                arc(centre + u, centre + u + v, centre + u + tip, true),
                arc(centre + u, centre + u + tip, centre + u - v, true),
                line(centre + u - v, centre - u - v),
                arc(centre - u, centre - u - v, centre - u - tip, true),
                arc(centre - u, centre - u - tip, centre - u + v, true)};
    } else {
        for (int k = 0; k < 4; ++k)
            loop.push_back(arc(centre, on_circle(centre, radius, turn - k * kPi / 2),
                               on_circle(centre, radius, turn - (k + 1) * kPi / 2), true));
        loop.back().to = loop.front().from;
    }
    return loop;
}

} // namespace

test::PlaneDomain held_domain(std::uint32_t seed, int number)
{
    Dice dice(seed * 747796405U + static_cast<std::uint32_t>(number) * 2891336453U + 12345U);
    for (int i = 0; i < 8; ++i) dice.unit(); // seeds nearby begin alike
    const Grid grid = cells_of(dice);
    test::PlaneDomain domain{"held", {rim_of(dice, outline_of(grid))}, {}};
    for (int i = 0; i < kCells; ++i) {
        for (int j = 0; j < kCells; ++j) {
            if (grid.has(i, j) && dice.chance(0.35))
                domain.loops.push_back(hole_in(dice, grid.at(i, j), grid.at(i + 1, j + 1)));
        }
    }
    const Eigen::Rotation2Dd turn(dice.between(0, 2 * kPi));
    for (Loop& loop : domain.loops) {
        for (PlaneCurve& curve : loop) {
            for (Vec2* p : {&curve.from, &curve.to, &curve.centre}) *p = turn * *p;
        }
    }
    return domain;
}

} // namespace lacuna::bench
