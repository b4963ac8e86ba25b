// SPDX-License-Identifier: MIT
#include "plane_domains.h"

#include <lacuna/geometry/shared/predicates.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace lacuna::test {

namespace {

constexpr double kPi = std::numbers::pi;

Vec2 on_circle(const Vec2& centre, double radius, double angle)
{
    return centre + radius * Vec2(std::cos(angle), std::sin(angle));
}

PlaneCurve line(const Vec2& from, const Vec2& to)
{
    return {PlaneCurve::Kind::line, from, to, {0, 0}, false, {}};
}

PlaneCurve arc(const Vec2& centre, double radius, double start, double end)
{
    return {PlaneCurve::Kind::arc,
            on_circle(centre, radius, start),
            on_circle(centre, radius, end),
            centre,
            end < start,
            {}};
}

PlaneCurve through(std::vector<Vec2> points)
{
    return {PlaneCurve::Kind::free, points.front(), points.back(), {0, 0}, false, std::move(points)};
}

std::vector<PlaneCurve> polygon(const std::vector<Vec2>& corners)
{
    std::vector<PlaneCurve> curves;
    for (std::size_t i = 0; i < corners.size(); ++i)
        curves.push_back(line(corners[i], corners[(i + 1) % corners.size()]));
    return curves;
}

/// Four arcs; clockwise for a hole.
std::vector<PlaneCurve> circle(const Vec2& centre, double radius, bool hole)
{
    std::vector<PlaneCurve> curves;
    for (int i = 0; i < 4; ++i) {
        const double from = (hole ? -i : i) * kPi / 2;
        curves.push_back(arc(centre, radius, from, from + (hole ? -kPi / 2 : kPi / 2)));
    }
    return curves;
}

/// A box about the origin with round corners; a corner as wide as the box is high makes half circles of two.
std::vector<PlaneCurve> rounded_box(double half_width, double half_height, double radius)
{
    std::vector<PlaneCurve> curves;
    const std::array<Vec2, 4> centre{
        Vec2(half_width - radius, half_height - radius), Vec2(radius - half_width, half_height - radius),
        Vec2(radius - half_width, radius - half_height), Vec2(half_width - radius, radius - half_height)};
    for (std::size_t i = 0; i < 4; ++i) {
        const double start = static_cast<double>(i) * kPi / 2;
        curves.push_back(arc(centre[i], radius, start, start + kPi / 2));
        const Vec2 next = on_circle(centre[(i + 1) % 4], radius, start + kPi / 2);
        if ((next - curves.back().to).norm() > 1e-9) curves.push_back(line(curves.back().to, next));
    }
    return curves;
}

PlaneDomain plate_with_holes()
{
    PlaneDomain plate{"plate", {polygon({{-1.5, -1}, {1.5, -1}, {1.5, 1}, {-1.5, 1}})}, {}};
    for (const Vec2& centre : {Vec2(0, 0), Vec2(-1, -0.5), Vec2(1, -0.5), Vec2(1, 0.5), Vec2(-1, 0.5)})
        plate.loops.push_back(circle(centre, centre.norm() > 0 ? 0.2 : 0.4, true));
    return plate;
}

PlaneDomain gear()
{
    constexpr int kTeeth = 16;
    constexpr double kRoot = 0.8, kTip = 1;
    std::vector<PlaneCurve> rim;
    const double pitch = 2 * kPi / kTeeth;
    for (int tooth = 0; tooth < kTeeth; ++tooth) {
        const double start = tooth * pitch;
        const std::array<double, 5> at{start, start + 0.4 * pitch, start + 0.55 * pitch, start + 0.85 * pitch,
                                       start + pitch};
        rim.push_back(arc({0, 0}, kRoot, at[0], at[1]));
        rim.push_back(line(on_circle({0, 0}, kRoot, at[1]), on_circle({0, 0}, kTip, at[2])));
        rim.push_back(arc({0, 0}, kTip, at[2], at[3]));
        rim.push_back(line(on_circle({0, 0}, kTip, at[3]), on_circle({0, 0}, kRoot, at[4])));
    }
    return {"gear", {rim, circle({0, 0}, 0.35, true)}, {}};
}

PlaneDomain comb()
{
    constexpr int kTeeth = 5;
    std::vector<Vec2> corners{{0, 0}, {9, 0}};
    for (int tooth = kTeeth - 1; tooth >= 0; --tooth) {
        corners.emplace_back(2 * tooth + 1, 5);
        corners.emplace_back(2 * tooth, 5);
        if (tooth == 0) break;
        corners.emplace_back(2 * tooth, 1.5);
        corners.emplace_back(2 * tooth - 1, 1.5);
    }
    return {"comb", {polygon(corners)}, {}};
}

/// NACA 0012 at eight degrees in a channel; the trailing edge is sharp.
PlaneDomain aerofoil()
{
    constexpr int kPoints = 800;
    const Eigen::Rotation2Dd turn(-8 * kPi / 180);
    const auto half = [&](double side) {
        std::vector<Vec2> points;
        for (int i = 0; i <= kPoints; ++i) {
            const double s = static_cast<double>(i) / kPoints;
            const double x = s * s; // crowds at the nose
            const double y = i == kPoints ? 0
                                          : 0.6 * (0.2969 * s - 0.126 * x - 0.3516 * x * x +
                                                   0.2843 * x * x * x - 0.1036 * x * x * x * x);
            points.push_back(turn * Vec2(x, side * y));
        }
        return points;
    };
    std::vector<Vec2> lower = half(-1);
    std::reverse(lower.begin(), lower.end());
    return {"aerofoil",
            {polygon({{-1, -1}, {2.5, -1}, {2.5, 1}, {-1, 1}}), {through(lower), through(half(1))}},
            {}};
}

/// Plan of z = (x² - y²) / 2 over a patch with four cubic sides; sizes shrink in plan where the face is
/// steep.
PlaneDomain saddle_plan()
{
    const std::array<Vec2, 4> corner{Vec2(-1, -1), Vec2(1.1, -0.9), Vec2(1, 1.1), Vec2(-0.9, 0.9)};
    const std::array<double, 4> bulge{0.25, -0.2, 0.3, 0.15};
    std::vector<PlaneCurve> rim;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec2 a = corner[i], d = corner[(i + 1) % 4];
        const Vec2 out = bulge[i] * Vec2(d.y() - a.y(), a.x() - d.x());
        const Vec2 b = a + (d - a) / 3 + out, c = a + 2 * (d - a) / 3 - out / 2;
        std::vector<Vec2> points;
        for (int k = 0; k <= 400; ++k) {
            const double t = k / 400.0, s = 1 - t;
            points.push_back(
                k == 0     ? a
                : k == 400 ? d
                           : Vec2(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d));
        }
        rim.push_back(through(std::move(points)));
    }
    return {"saddle plan", {rim}, [](const Vec2& p) { return std::pow(1 + p.squaredNorm(), -0.25); }};
}

bool inside(const std::vector<std::vector<Vec2>>& loops, const Vec2& p)
{
    return std::count_if(loops.begin(), loops.end(),
                         [&](const auto& loop) { return geometry::lies_inside(loop, p); }) %
               2 !=
           0;
}

/// The integral of 1 / size² over a domain.
double quads_at_size_one(const PlaneDomain& domain)
{
    std::vector<std::vector<Vec2>> loops;
    Eigen::AlignedBox2d box;
    for (const auto& curves : domain.loops) {
        loops.emplace_back();
        for (const PlaneCurve& curve : curves) {
            const std::vector<Vec2> points = fine_line(curve);
            loops.back().insert(loops.back().end(), points.begin(), points.end() - 1);
            for (const Vec2& p : points) box.extend(p);
        }
    }
    double sum = 0;
    if (!domain.relative_size) {
        for (const auto& loop : loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
                sum += (a.x() * b.y() - a.y() * b.x()) / 2;
            }
        }
        return sum;
    }
    constexpr int kCells = 150;
    const Vec2 cell = box.sizes() / kCells;
    for (int i = 0; i < kCells; ++i) {
        for (int j = 0; j < kCells; ++j) {
            const Vec2 p = box.min() + cell.cwiseProduct(Vec2(i + 0.5, j + 0.5));
            if (inside(loops, p)) sum += cell.prod() / std::pow(domain.relative_size(p), 2);
        }
    }
    return sum;
}

/// Nodes of a curve but its last: an even number of sides, each as long as the others measured by the size.
int seed_curve(const PlaneDomain& domain, const PlaneCurve& curve, double size, std::vector<Vec2>& nodes)
{
    const std::vector<Vec2> points = fine_line(curve);
    std::vector<double> run{0};
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double asked = domain.relative_size ? domain.relative_size((points[i] + points[i - 1]) / 2) : 1;
        run.push_back(run.back() + (points[i] - points[i - 1]).norm() / asked);
    }
    const int sides = 2 * std::max(1, static_cast<int>(std::lround(run.back() / size / 2)));
    std::size_t piece = 0;
    for (int k = 0; k < sides; ++k) {
        const double s = run.back() * k / sides;
        while (piece + 2 < run.size() && run[piece + 1] <= s) ++piece;
        const double t = (s - run[piece]) / (run[piece + 1] - run[piece]);
        Vec2 node = points[piece] + t * (points[piece + 1] - points[piece]);
        if (curve.kind == PlaneCurve::Kind::arc)
            node = curve.centre + (curve.from - curve.centre).norm() * (node - curve.centre).normalized();
        nodes.push_back(k == 0 ? curve.from : node);
    }
    return sides;
}

} // namespace

std::vector<Vec2> fine_line(const PlaneCurve& curve)
{
    if (curve.kind == PlaneCurve::Kind::free) return curve.through;
    constexpr int kPieces = 256;
    std::vector<Vec2> points{curve.from};
    const Vec2 start = curve.from - curve.centre, end = curve.to - curve.centre;
    double turn = std::atan2(start.x() * end.y() - start.y() * end.x(), start.dot(end));
    if (curve.clockwise && turn > 0) turn -= 2 * kPi;
    if (!curve.clockwise && turn < 0) turn += 2 * kPi;
    for (int i = 1; i < kPieces; ++i) {
        const double t = static_cast<double>(i) / kPieces;
        points.push_back(curve.kind == PlaneCurve::Kind::line
                             ? Vec2(curve.from + t * (curve.to - curve.from))
                             : Vec2(curve.centre + Eigen::Rotation2Dd(t * turn) * start));
    }
    points.push_back(curve.to);
    return points;
}

std::vector<PlaneDomain> plane_domains()
{
    return {{"disc", {circle({0, 0}, 1, false)}, {}},
            plate_with_holes(),
            gear(),
            {"L", {polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})}, {}},
            comb(),
            aerofoil(),
            saddle_plan()};
}

std::vector<PlaneDomain> common_outlines()
{
    PlaneDomain flange{"flange", {circle({0, 0}, 1, false)}, {}};
    for (int i = 0; i < 4; ++i)
        flange.loops.push_back(circle(on_circle({0, 0}, 0.66, (2 * i + 1) * kPi / 4), 0.12, true));
    return {
        {"ring", {circle({0, 0}, 1, false), circle({0, 0}, 0.4, true)}, {}},
        {"eccentric ring", {circle({0, 0}, 1, false), circle({0.3, 0}, 0.35, true)}, {}},
        {"rounded rectangle", {rounded_box(1.5, 1, 0.4)}, {}},
        {"slot", {rounded_box(1.5, 0.5, 0.5)}, {}},
        {"U", {polygon({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 2}, {0, 2}})}, {}},
        {"T",
         {polygon({{-0.4, 0}, {0.4, 0}, {0.4, 2}, {1.5, 2}, {1.5, 2.8}, {-1.5, 2.8}, {-1.5, 2}, {-0.4, 2}})},
         {}},
        {"cross",
         {polygon({{-0.5, -1.5},
                   {0.5, -1.5},
                   {0.5, -0.5},
                   {1.5, -0.5},
                   {1.5, 0.5},
                   {0.5, 0.5},
                   {0.5, 1.5},
                   {-0.5, 1.5},
                   {-0.5, 0.5},
                   {-1.5, 0.5},
                   {-1.5, -0.5},
                   {-0.5, -0.5}})},
         {}},
        std::move(flange)};
}

PlaneDomain plane_domain(const std::string& name)
{
    for (const auto& list : {plane_domains(), common_outlines()}) {
        for (const PlaneDomain& domain : list) {
            if (domain.name == name) return domain;
        }
    }
    throw std::invalid_argument("no domain is called " + name);
}

SeededDomain seed_domain(const PlaneDomain& domain, double quads)
{
    SeededDomain seeded;
    seeded.size = std::sqrt(quads_at_size_one(domain) / quads);
    for (const auto& curves : domain.loops) {
        const std::size_t first = seeded.region.points.size();
        seeded.sides.emplace_back();
        for (const PlaneCurve& curve : curves)
            seeded.sides.back().push_back(seed_curve(domain, curve, seeded.size, seeded.region.points));
        seeded.region.loops.emplace_back();
        for (std::size_t p = first; p < seeded.region.points.size(); ++p)
            seeded.region.loops.back().push_back(static_cast<Index>(p));
    }
    seeded.region.size = [size = seeded.size, relative = domain.relative_size](const Vec2& p) {
        return relative ? size * relative(p) : size;
    };
    return seeded;
}

} // namespace lacuna::test
