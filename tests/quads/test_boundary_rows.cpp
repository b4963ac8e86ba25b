// SPDX-License-Identifier: MIT
#include <lacuna/quads/shared/boundary_rows.h>

#include <lacuna/quads/shared/measure_plane.h>
#include <lacuna/quads/shared/pave.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace lacuna;
using quads::BoundaryRows;
using quads::PlanarRegion;
using quads::RowsFinding;
using quads::RowTurn;

namespace {

struct RowOutline {
    PlanarRegion region;
    BoundaryRows rows;
    std::vector<std::vector<Vec2>> corners; ///< of each loop
};

/// Add a polygon with tables on its sides; nodes near its inner corners stand at the heights of the rows that
/// end there.
void add_polygon(RowOutline& outline, const std::vector<Vec2>& corners, const std::vector<int>& tables,
                 double size)
{
    const std::size_t n = corners.size();
    const auto turn_at = [&](std::size_t i) {
        const Vec2 in = corners[i % n] - corners[(i + n - 1) % n],
                   out = corners[(i + 1) % n] - corners[i % n];
        const double left = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
        const double limit = std::numbers::pi / 4;
        return left > limit ? RowTurn::inner : left < -limit ? RowTurn::outer : RowTurn::smooth;
    };
    std::vector<Index>& loop = outline.region.loops.emplace_back();
    outline.corners.push_back(corners);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % n];
        const double length = (b - a).norm();
        std::vector<double> at{0}, from_end;
        const auto ends_of = [&](std::size_t corner, std::size_t beyond, std::vector<double>& places) {
            const int table = tables[beyond];
            if (table < 0 || turn_at(corner) != RowTurn::inner) return;
            const Vec2 u = (corners[(beyond + 1) % n] - corners[beyond]).normalized();
            const double sine = std::abs(u.x() * (b - a).y() - u.y() * (b - a).x()) / length;
            for (const double h : outline.rows.heights[static_cast<std::size_t>(table)])
                places.push_back(h / sine);
        };
        ends_of(i, (i + n - 1) % n, at);
        ends_of((i + 1) % n, (i + 1) % n, from_end);
        const double low = at.back(), high = length - (from_end.empty() ? 0 : from_end.back());
        const int between = 2 * std::max(1, static_cast<int>((high - low) / size / 2));
        for (int k = 1; k < between; ++k) at.push_back(low + (high - low) * k / between);
        for (std::size_t k = from_end.size(); k-- > 0;) at.push_back(length - from_end[k]);
        for (std::size_t k = 0; k < at.size(); ++k) {
            loop.push_back(static_cast<Index>(outline.region.points.size()));
            outline.region.points.push_back(a + (b - a) / length * at[k]);
            outline.rows.table.push_back(tables[i]);
            outline.rows.turn.push_back(k == 0 ? turn_at(i) : RowTurn::smooth);
        }
    }
}

/// One node more on the longest side of the last loop without rows in the way, where the sides are odd.
void make_even(RowOutline& outline)
{
    if (outline.region.points.size() % 2 == 0) return;
    std::vector<Index>& loop = outline.region.loops.back();
    std::size_t longest = 0;
    double most = 0;
    const auto at = [&](std::size_t i) { return outline.region.points[index(loop[i % loop.size()])]; };
    for (std::size_t i = 0; i < loop.size(); ++i) {
        if ((at(i + 1) - at(i)).norm() <= most) continue;
        most = (at(i + 1) - at(i)).norm();
        longest = i;
    }
    const Index fresh = static_cast<Index>(outline.region.points.size());
    outline.region.points.push_back((at(longest) + at(longest + 1)) / 2);
    outline.rows.table.push_back(outline.rows.table[index(loop[longest])]);
    outline.rows.turn.push_back(RowTurn::smooth);
    loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(longest) + 1, fresh);
}

std::vector<Vec2> regular(int sides, double radius, bool clockwise = false, const Vec2& centre = {0, 0})
{
    std::vector<Vec2> corners;
    for (int i = 0; i < sides; ++i) {
        const double angle = (clockwise ? -1 : 1) * 2 * std::numbers::pi * i / sides;
        corners.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return corners;
}

quads::RowsFilling fill(const RowOutline& outline)
{
    return quads::fill_with_rows(outline.region, outline.rows, [](const auto& region, const auto& context) {
        return quads::pave(region, {}, context).mesh;
    });
}

/// Walk the rows from every side with a table: quads one behind the other, their nodes at its heights over
/// the side's line.
void check_rows(const RowOutline& outline, const quads::PlanarQuads& mesh)
{
    for (const auto& loop : outline.region.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int table = outline.rows.table[index(loop[i])];
            if (table < 0) continue;
            Index a = loop[i], b = loop[(i + 1) % loop.size()];
            const Vec2 foot = mesh.points[index(a)];
            const Vec2 along = (mesh.points[index(b)] - foot).normalized(), normal(-along.y(), along.x());
            for (const double height : outline.rows.heights[static_cast<std::size_t>(table)]) {
                bool found = false;
                for (const Quad& quad : mesh.quads) {
                    for (std::size_t k = 0; k < 4 && !found; ++k) {
                        if (quad[k] != a || quad[(k + 1) % 4] != b) continue;
                        const Index next_a = quad[(k + 3) % 4], next_b = quad[(k + 2) % 4];
                        CHECK((mesh.points[index(next_a)] - foot).dot(normal) == doctest::Approx(height));
                        CHECK((mesh.points[index(next_b)] - foot).dot(normal) == doctest::Approx(height));
                        a = next_a;
                        b = next_b;
                        found = true;
                    }
                    if (found) break;
                }
                REQUIRE(found);
            }
        }
    }
}

void check_filled(const RowOutline& outline)
{
    const quads::RowsFilling filling = fill(outline);
    REQUIRE_FALSE(filling.finding);
    CHECK(quads::find_fault(filling.mesh, outline.region) == "");
    CHECK(quads::measure_plane(filling.mesh, outline.region).min_scaled_jacobian > 0.1);
    check_rows(outline, filling.mesh);
}

} // namespace

TEST_CASE("rows stand at their heights over any sides of convex polygons")
{
    for (const int sides : {3, 4, 5, 6, 7}) {
        for (int chosen = 1; chosen < 1 << sides; ++chosen) {
            CAPTURE(sides);
            CAPTURE(chosen);
            RowOutline outline;
            outline.rows.heights = {{0.02, 0.05, 0.09}};
            std::vector<int> tables;
            for (int i = 0; i < sides; ++i) tables.push_back((chosen >> i) & 1 ? 0 : -1);
            add_polygon(outline, regular(sides, 1), tables, 0.2);
            make_even(outline);
            check_filled(outline);
        }
    }
}

TEST_CASE("rows go round outward corners, with tables of their own")
{
    for (const int sides : {3, 4, 5}) {
        for (int chosen = 1; chosen < 1 << sides; ++chosen) {
            CAPTURE(sides);
            CAPTURE(chosen);
            RowOutline outline;
            outline.rows.heights = {{0.02, 0.05, 0.09}, {0.03, 0.06}};
            std::vector<int> tables;
            for (int i = 0; i < sides; ++i) tables.push_back((chosen >> i) & 1 ? i % 2 : -1);
            add_polygon(outline, regular(4, 2), {-1, -1, -1, -1}, 0.2);
            add_polygon(outline, regular(sides, 0.6, true, {0.1, 0.05}), tables, 0.2);
            make_even(outline);
            check_filled(outline);
        }
    }
}

TEST_CASE("rows go round a coarse hole without corners, and end in the middle of a side")
{
    RowOutline outline;
    outline.rows.heights = {{0.05, 0.1}};
    add_polygon(outline, regular(4, 2), {-1, -1, -1, -1}, 0.2);
    add_polygon(outline, regular(6, 0.6, true), {0, 0, 0, 0, 0, 0}, 2);
    for (const Index p : outline.region.loops.back()) outline.rows.turn[index(p)] = RowTurn::smooth;
    make_even(outline);
    check_filled(outline);
    // Of the same hole half the sides.
    for (std::size_t i = 0; i < 6; ++i) outline.rows.table[index(outline.region.loops.back()[i])] = -1;
    check_filled(outline);
}

TEST_CASE("rows that do not fit are found, with the room there is")
{
    RowOutline narrow;
    narrow.rows.heights = {{0.3, 0.6}};
    add_polygon(narrow, {{0, 0}, {4, 0}, {4, 1}, {0, 1}}, {-1, -1, -1, -1}, 0.25);
    for (std::size_t i = 0; i < narrow.rows.table.size(); ++i) {
        const double y = narrow.region.points[i].y(), x = narrow.region.points[i].x();
        if ((y == 0 && x < 4) || (y == 1 && x > 0)) narrow.rows.table[i] = 0;
    }
    for (RowTurn& turn : narrow.rows.turn) turn = turn == RowTurn::inner ? RowTurn::outer : turn;
    const quads::RowsFilling none = fill(narrow);
    REQUIRE(none.finding);
    CHECK(none.finding->why == RowsFinding::Why::no_room);
    CHECK(none.finding->asked == 0.6);
    CHECK(none.finding->found == doctest::Approx(1).epsilon(0.01));

    RowOutline bent;
    bent.rows.heights = {{0.5}};
    add_polygon(bent, regular(16, 0.4), std::vector<int>(16, 0), 1);
    CHECK(fill(bent).finding->why == RowsFinding::Why::sharp_bend);

    RowOutline off;
    off.rows.heights = {{0.1}};
    add_polygon(off, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {-1, -1, -1, -1}, 0.25);
    for (std::size_t i = 0; i < 4; ++i) off.rows.table[i] = 0;
    const quads::RowsFilling ends = fill(off);
    REQUIRE(ends.finding);
    CHECK(ends.finding->why == RowsFinding::Why::off_height);
    CHECK(ends.finding->found == doctest::Approx(0.25));

    RowOutline unlike;
    unlike.rows.heights = {{0.1}, {0.05}};
    add_polygon(unlike, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, {0, 1, -1, -1, -1}, 0.25);
    make_even(unlike);
    CHECK(fill(unlike).finding->why == RowsFinding::Why::unlike);
}
