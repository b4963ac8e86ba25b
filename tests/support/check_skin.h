// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/mesh/tet_mesh.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lacuna::test {

/// The volume within a skin; quads count as two triangles.
inline double volume_within(const mesh::ClosedSkin& skin)
{
    double sum = 0;
    const auto add = [&](Index a, Index b, Index c) {
        const auto& p = skin.points;
        sum += p[index(a)].dot(p[index(b)].cross(p[index(c)])) / 6;
    };
    for (const Triangle& t : skin.triangles) add(t[0], t[1], t[2]);
    for (const Quad& q : skin.quads) {
        add(q[0], q[1], q[2]);
        add(q[0], q[2], q[3]);
    }
    return sum;
}

/// Smallest angle of the triangles [degrees].
inline double smallest_angle(const mesh::ClosedSkin& skin)
{
    double least = 180;
    for (const Triangle& t : skin.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& at = skin.points[index(t[k])];
            const Vec3 a = skin.points[index(t[(k + 1) % 3])] - at,
                       b = skin.points[index(t[(k + 2) % 3])] - at;
            least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree);
        }
    }
    return least;
}

/// Every directed side of a cell is used once, and once in the other direction; every point is used.
inline void check_closed(const mesh::ClosedSkin& skin)
{
    std::map<std::uint64_t, int> uses;
    std::vector<char> used(skin.points.size(), 0);
    const auto add = [&](const auto& cell) {
        for (std::size_t k = 0; k < cell.size(); ++k) {
            ++uses[directed_key(cell[k], cell[(k + 1) % cell.size()])];
            used[index(cell[k])] = 1;
        }
    };
    for (const Triangle& t : skin.triangles) add(t);
    for (const Quad& q : skin.quads) add(q);
    std::size_t open = 0;
    for (const auto& [side, count] : uses) {
        const auto back = directed_key(static_cast<Index>(side & 0xffffffffU),
                                       static_cast<Index>(side >> 32));
        if (count != 1 || !uses.contains(back)) ++open;
    }
    CHECK(open == 0);
    CHECK(std::ranges::count(used, 0) == 0);
}

} // namespace lacuna::test
