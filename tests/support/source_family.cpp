// SPDX-License-Identifier: MIT
#include "support/source_family.h"
#include "support/plan_prism.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace lacuna::test {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurn = 2 * kPi;

Vec3 raised(const Vec2& p, double height) { return {p.x(), p.y(), height}; }

Vec2 on_ellipse(double a, double b, double angle) { return {a * std::cos(angle), b * std::sin(angle)}; }

/// Between two ellipses that have a point at each angle: s runs outward, t along.
PlanMap ring_part(double inner, double outer, double from, double to, double flat = 1)
{
    return [=](double s, double t) {
        const double angle = from + t * (to - from), radius = inner + s * (outer - inner);
        return on_ellipse(radius, radius * flat, angle);
    };
}

/// The part of a disc over a rectangle of the square [-1, 1]², by the elliptical map.
PlanMap disc_part(double x0, double y0, double x1, double y1, double radius = 1)
{
    return [=](double s, double t) {
        const double x = x0 + s * (x1 - x0), y = y0 + t * (y1 - y0);
        return Vec2(radius * x * std::sqrt(1 - y * y / 2), radius * y * std::sqrt(1 - x * x / 2));
    };
}

/// Between a round hole and a square about it: s runs outward, t along a quarter or half of one.
PlanMap hole_part(double hole, double half, double from, double to)
{
    return [=](double s, double t) {
        const double angle = from + t * (to - from);
        const Vec2 out(std::cos(angle), std::sin(angle));
        const double corner = std::max(std::abs(out.x()), std::abs(out.y()));
        return Vec2((hole + s * (half / corner - hole)) * out);
    };
}

struct Case {
    std::string name;
    std::vector<PlanPatch> patches;
    int least = 0;
    bool grid = false;
    SpaceMap map{};
};

std::vector<Case> plane_cases()
{
    std::vector<Case> cases;
    const auto ring = [](double inner, double outer, int faces, double flat, double shift) {
        std::vector<PlanPatch> patches;
        const int each = std::max(1, 4 / faces); // patches a face
        for (int k = 0; k < faces * each; ++k) {
            const double step = kTurn / (faces * each);
            patches.push_back({k / each,
                               ring_part(inner, outer, shift + k * step, shift + (k + 1) * step, flat),
                               {0, 1 + k / each, 0, 11 + k / each}});
        }
        return patches;
    };
    cases.push_back({"ring in halves", ring(0.5, 1, 2, 1, 0), 0, true});
    cases.push_back({"thin ring in halves", ring(0.8, 1, 2, 1, 0), 0, true});
    cases.push_back({"ring in three", ring(0.4, 1, 3, 1, 0.3), 0, true});
    cases.push_back({"ring in quarters", ring(0.6, 1, 4, 1, 0.5), 0, true});
    cases.push_back({"flat ring in halves", ring(0.8, 1, 2, 0.4, 0), 0, false});
    cases.push_back({"flat ring in quarters", ring(0.7, 1, 4, 0.5, 0), 0, false});
    cases.push_back({"disc in halves",
                     {{0, disc_part(-1, 0, 1, 1), {0, 1, 1, 1}}, {1, disc_part(-1, -1, 1, 0), {2, 2, 0, 2}}},
                     4});
    cases.push_back({"disc in quarters",
                     {{0, disc_part(0, 0, 1, 1), {0, 1, 1, 0}},
                      {1, disc_part(-1, 0, 0, 1), {0, 0, 2, 2}},
                      {2, disc_part(-1, -1, 0, 0), {3, 0, 0, 3}},
                      {3, disc_part(0, -1, 1, 0), {4, 4, 0, 0}}},
                     4});
    std::vector<PlanPatch> core;
    core.push_back({0, disc_part(-1, -1, 1, 1, 0.5)});
    for (int k = 0; k < 4; ++k) {
        core.push_back({1,
                        [k](double s, double t) {
                            const Vec2 rim = disc_part(-1, -1, 1, 1)(1, t) * (0.5 + s / 2);
                            const double turn = k * kPi / 2;
                            return Vec2(rim.x() * std::cos(turn) - rim.y() * std::sin(turn),
                                        rim.x() * std::sin(turn) + rim.y() * std::cos(turn));
                        },
                        {0, 1, 0, 0}});
    }
    cases.push_back({"disc of core and ring", core, 4});
    // Core and ring cut alike: a patch of the ring on each side of the core's patches.
    const auto cut_core = [](int faces) {
        std::vector<PlanPatch> patches;
        for (int k = 0; k < 4; ++k) {
            const double turn = k * kPi / 2;
            const auto turned = [turn](const Vec2& p) {
                return Vec2(p.x() * std::cos(turn) - p.y() * std::sin(turn),
                            p.x() * std::sin(turn) + p.y() * std::cos(turn));
            };
            const int face = k * faces / 4;
            const PlanMap quarter = disc_part(0, 0, 1, 1, 0.5);
            patches.push_back({face, [=](double s, double t) { return turned(quarter(s, t)); }});
            for (const bool upper : {false, true}) {
                patches.push_back({faces + face,
                                   [=](double s, double t) {
                                       const Vec2 rim = upper ? quarter(1 - t, 1) : quarter(1, t);
                                       return turned(rim * (1 + s));
                                   },
                                   {0, 1 + face, 0, 0}});
            }
        }
        return patches;
    };
    cases.push_back({"core and ring in halves", cut_core(2), 4});
    cases.push_back({"core and ring in quarters", cut_core(4), 4});
    const auto moved = [](const PlanMap& map, const Vec2& by) {
        return [=](double s, double t) { return Vec2(map(s, t) + by); };
    };
    cases.push_back({"slot of three",
                     {{0, rectangle(-1, -0.5, 1, 0.5)},
                      {1, moved(disc_part(0, -1, 1, 1, 0.5), {1, 0}), {1, 1, 1, 0}},
                      {2, moved(disc_part(-1, -1, 0, 1, 0.5), {-1, 0}), {2, 0, 2, 2}}},
                     4});
    const auto holed = [](const std::array<int, 8>& face) {
        std::vector<PlanPatch> patches;
        for (std::size_t k = 0; k < 8; ++k) {
            // Sides of the square turn at odd numbers of eighths.
            const int side = static_cast<int>((k + 1) / 2) % 4;
            patches.push_back({face[k],
                               hole_part(0.4, 1, double(k) * kPi / 4, double(k + 1) * kPi / 4),
                               {0, 10 * (face[k] + 1) + side, 0, 50 + face[k]}});
        }
        return patches;
    };
    cases.push_back({"holed plate in halves", holed({0, 0, 0, 0, 1, 1, 1, 1}), 4});
    cases.push_back({"holed plate in quarters", holed({0, 0, 1, 1, 2, 2, 3, 3}), 4});
    cases.push_back({"L of two",
                     {{0, rectangle(0, 0, 1, 1), {1, 0, 0, 2}},
                      {0, rectangle(0, 1, 1, 2.3), {0, 3, 4, 2}},
                      {1, rectangle(1, 0, 2.7, 1), {0, 5, 6, 0}}},
                     0,
                     true});
    cases.push_back({"T of three",
                     {{0, rectangle(0, 0, 1.1, 0.9)},
                      {1, rectangle(1.1, 0, 1.9, 0.9)},
                      {2, rectangle(1.9, 0, 3.3, 0.9)},
                      {1, rectangle(1.1, 0.9, 1.9, 2.6)}},
                     0,
                     true});
    cases.push_back({"board of unlike",
                     {{0, rectangle(0, 0, 1, 0.7)},
                      {1, rectangle(1, 0, 2.37, 0.7)},
                      {2, rectangle(0, 0.7, 1, 1.83)},
                      {3, rectangle(1, 0.7, 2.37, 1.83)}},
                     0,
                     true});
    const auto wedge = [](Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
        return [=](double s, double t) {
            return Vec2((1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d);
        };
    };
    cases.push_back({"trapezia in a row",
                     {{0, wedge({0, 0}, {1, 0}, {1, 1.5}, {0, 1})},
                      {1, wedge({1, 0}, {2, 0}, {2, 0.8}, {1, 1.5})},
                      {2, wedge({2, 0}, {3.2, 0}, {3.2, 1.2}, {2, 0.8})}},
                     0,
                     true});
    return cases;
}

/// A surface of the plan, and as it is moved along a way.
SpaceMap moved_along(std::function<Vec3(const Vec2&)> surface, const Vec3& way)
{
    return [=](const Vec2& p, double height) { return Vec3(surface(p) + height * way); };
}

std::vector<Case> curved_cases()
{
    std::vector<Case> cases;
    // x along the axis or meridian, y round it; the height blows up the radius.
    const auto about_axis = [](double radius_from, double radius_to) -> SpaceMap {
        return [=](const Vec2& p, double height) {
            const double radius = (radius_from + p.x() * (radius_to - radius_from)) * (1 + 0.3 * height);
            return Vec3(p.x(), radius * std::sin(p.y()), radius * std::cos(p.y()));
        };
    };
    const auto strips = [](double angle, int faces) {
        std::vector<PlanPatch> patches;
        for (int k = 0; k < faces; ++k)
            patches.push_back(
                {k,
                 rectangle(0, angle * (double(k) / faces - 0.5), 1, angle * (double(k + 1) / faces - 0.5)),
                 {0, 1, 0, 2}});
        return patches;
    };
    cases.push_back({"half cylinder", strips(kPi, 1), 0, true, about_axis(0.7, 0.7)});
    cases.push_back({"half cylinder in halves", strips(kPi, 2), 0, true, about_axis(0.7, 0.7)});
    cases.push_back({"half cone", strips(kPi, 1), 0, false, about_axis(0.3, 0.8)});
    cases.push_back({"half cone in three", strips(kPi, 3), 0, false, about_axis(0.35, 0.8)});
    cases.push_back({"steep half cone", strips(kPi, 1), 0, false, about_axis(0.15, 1.2)});
    const auto sphere = [](const Vec2& p, double height) {
        const double radius = 1 + 0.3 * height; // p: longitude and latitude
        return Vec3(radius * std::cos(p.y()) * std::sin(p.x()), radius * std::sin(p.y()),
                    radius * std::cos(p.y()) * std::cos(p.x()));
    };
    cases.push_back({"sphere patch", {{0, rectangle(-0.9, -0.9, 0.9, 0.9)}}, 0, false, sphere});
    cases.push_back({"tall sphere patch", {{0, rectangle(-0.7, -0.2, 0.7, 1.2)}}, 0, false, sphere});
    cases.push_back({"sphere in halves",
                     {{0, rectangle(-0.9, -0.9, 0, 0.9)}, {1, rectangle(0, -0.9, 0.9, 0.9)}},
                     0,
                     false,
                     sphere});
    const auto up = [](auto surface) { return moved_along(surface, Vec3(0, 0, 1.5)); };
    cases.push_back({"saddle", {{0, rectangle(-1, -1, 1, 1)}}, 0, true, up([](const Vec2& p) {
                         return Vec3(p.x(), p.y(), 0.5 * (p.x() * p.x() - p.y() * p.y()));
                     })});
    cases.push_back(
        {"saddle in quarters",
         {{0, rectangle(-1, -1, 0, 0)},
          {1, rectangle(0, -1, 1, 0)},
          {2, rectangle(-1, 0, 0, 1)},
          {3, rectangle(0, 0, 1, 1)}},
         0,
         true,
         up([](const Vec2& p) { return Vec3(p.x(), p.y(), 0.5 * (p.x() * p.x() - p.y() * p.y())); })});
    cases.push_back({"twisted", {{0, rectangle(-1, -0.6, 1, 0.6)}}, 0, true, up([](const Vec2& p) {
                         return Vec3(p.x(), p.y(), 0.9 * p.x() * p.y());
                     })});
    cases.push_back(
        {"domed disc", {{0, disc_part(-1, -1, 1, 1), {1, 1, 1, 1}}}, 4, false, up([](const Vec2& p) {
             return Vec3(p.x(), p.y(), 0.45 * p.squaredNorm());
         })});
    // The plan's unit circle becomes the parallel 80° from the pole.
    const auto dome = [](const Vec2& p, double height) {
        const double radius = 1 + 0.3 * height, polar = p.norm() * 80 * kPi / 180;
        const double out = p.norm() > 0 ? std::sin(polar) / p.norm() : 0;
        return Vec3(radius * out * p.x(), radius * out * p.y(), radius * std::cos(polar));
    };
    cases.push_back({"deep dome", {{0, disc_part(-1, -1, 1, 1), {1, 1, 1, 1}}}, 4, false, dome});
    cases.push_back({"deep dome in halves",
                     {{0, disc_part(-1, 0, 1, 1), {0, 1, 1, 1}}, {1, disc_part(-1, -1, 1, 0), {2, 2, 0, 2}}},
                     4,
                     false,
                     dome});
    const auto wave = [](const Vec2& p) {
        return Vec3(p.x(), p.y(), 0.25 * std::sin(2.5 * p.x()) * std::cos(2 * p.y()));
    };
    std::vector<PlanPatch> holed;
    for (int k = 0; k < 8; ++k) {
        holed.push_back({k / 4,
                         hole_part(0.4, 1, k * kPi / 4, (k + 1) * kPi / 4),
                         {0, 10 * (k / 4 + 1) + (k + 1) / 2 % 4, 0, 50 + k / 4}});
    }
    cases.push_back({"waved holed plate in halves", holed, 4, false, up(wave)});
    std::vector<PlanPatch> ring;
    for (int k = 0; k < 4; ++k)
        ring.push_back({k / 2, ring_part(0.45, 1, k * kPi / 2, (k + 1) * kPi / 2), {0, 1 + k / 2, 0, 11}});
    cases.push_back({"dished ring in halves", ring, 0, true,
                     up([](const Vec2& p) { return Vec3(p.x(), p.y(), 0.6 * p.squaredNorm()); })});
    // A half cylinder with a hole through its skin.
    std::vector<PlanPatch> skin = holed;
    for (PlanPatch& patch : skin) {
        patch.face = 0;
        patch.wall[1] %= 10;
        patch.wall[1] += 20;
        patch.wall[3] = 50;
    }
    cases.push_back({"holed half cylinder", skin, 4, false, [](const Vec2& p, double height) {
                         const double radius = 2 / kPi * (1 + 0.3 * height), angle = p.y() * kPi / 2;
                         return Vec3(p.x(), radius * std::sin(angle), radius * std::cos(angle));
                     }});
    return cases;
}

} // namespace

std::vector<FamilySource> source_family(int facets)
{
    std::vector<FamilySource> family;
    for (const bool plane : {true, false}) {
        for (Case& own : plane ? plane_cases() : curved_cases()) {
            const SpaceMap map = own.map ? own.map : SpaceMap(raised);
            family.push_back({own.name, prism_over(own.patches, map, facets), own.least, plane, own.grid});
        }
    }
    return family;
}

} // namespace lacuna::test
