// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace lacuna::test {

/// Quads of the plane with the region they fill.
struct PlaneGrid {
    quads::PlanarQuads mesh;
    quads::PlanarRegion region;
};

/// Renumber so that the boundary comes first, in walking order, and make the region of it. @pre one boundary
/// loop
inline PlaneGrid with_region(const quads::PlanarQuads& raw)
{
    std::map<Index, Index> next;
    std::map<std::pair<Index, Index>, int> used;
    for (const Quad& quad : raw.quads) {
        for (std::size_t k = 0; k < 4; ++k) ++used[{quad[k], quad[(k + 1) % 4]}];
    }
    for (const auto& [side, count] : used) {
        if (!used.contains({side.second, side.first})) next[side.first] = side.second;
    }
    std::vector<Index> number(raw.points.size(), -1);
    PlaneGrid grid;
    grid.region.loops.emplace_back();
    for (Index p = next.begin()->first; number[static_cast<std::size_t>(p)] < 0; p = next.at(p)) {
        number[static_cast<std::size_t>(p)] = static_cast<Index>(grid.mesh.points.size());
        grid.region.loops[0].push_back(number[static_cast<std::size_t>(p)]);
        grid.mesh.points.push_back(raw.points[static_cast<std::size_t>(p)]);
    }
    grid.region.points = grid.mesh.points;
    for (std::size_t p = 0; p < raw.points.size(); ++p) {
        if (number[p] >= 0) continue;
        number[p] = static_cast<Index>(grid.mesh.points.size());
        grid.mesh.points.push_back(raw.points[p]);
    }
    for (Quad quad : raw.quads) {
        for (Index& p : quad) p = number[static_cast<std::size_t>(p)];
        grid.mesh.quads.push_back(quad);
    }
    return grid;
}

/// Unit squares from (0, 0) to (m, n), less those a test takes out.
template <class Keep>
PlaneGrid plane_grid(int m, int n, const Keep& keep)
{
    quads::PlanarQuads raw;
    std::vector<Index> number(static_cast<std::size_t>((m + 1) * (n + 1)), -1);
    const auto at = [&](int i, int j) {
        Index& p = number[static_cast<std::size_t>(j * (m + 1) + i)];
        if (p < 0) {
            p = static_cast<Index>(raw.points.size());
            raw.points.emplace_back(i, j);
        }
        return p;
    };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < m; ++i) {
            if (keep(i, j)) raw.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return with_region(raw);
}

inline PlaneGrid plane_grid(int m, int n)
{
    return plane_grid(m, n, [](int, int) { return true; });
}

/// A square of 2n by 2n without its last quarter.
inline PlaneGrid plane_corner(int n)
{
    return plane_grid(2 * n, 2 * n, [n](int i, int j) { return i < n || j < n; });
}

/// A regular polygon of sides 2n long, a grid of n by n at every corner.
inline PlaneGrid plane_polygon(int sides, int n)
{
    quads::PlanarQuads raw;
    std::map<std::pair<long, long>, Index> known;
    const auto at = [&](const Vec2& p) {
        const auto key = std::pair(std::lround(p.x() * 1e6), std::lround(p.y() * 1e6));
        const auto [found, made] = known.try_emplace(key, static_cast<Index>(raw.points.size()));
        if (made) raw.points.push_back(p);
        return found->second;
    };
    const auto corner = [&](int i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        return Vec2(std::cos(angle), std::sin(angle));
    };
    for (int c = 0; c < sides; ++c) {
        const Vec2 a = corner(c), b = (corner(c) + corner(c + 1)) / 2,
                   d = (corner(c) + corner(c + sides - 1)) / 2;
        const auto place = [&](int i, int j) {
            const double s = static_cast<double>(i) / n, t = static_cast<double>(j) / n;
            return at((1 - s) * (1 - t) * a + s * (1 - t) * b + (1 - s) * t * d);
        };
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i)
                raw.quads.push_back({place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)});
        }
    }
    return with_region(raw);
}

template <class Function>
void map(PlaneGrid& grid, const Function& function)
{
    for (Vec2& p : grid.mesh.points) p = function(p);
    for (Vec2& p : grid.region.points) p = function(p);
}

/// Move inner points at random, at most so far in x and in y.
inline void shake(PlaneGrid& grid, double most, std::uint32_t seed)
{
    std::mt19937 engine(seed);
    const auto unit = [&] {
        return 2 * static_cast<double>(engine() >> 5) / static_cast<double>(1U << 27) - 1;
    };
    for (std::size_t p = grid.region.points.size(); p < grid.mesh.points.size(); ++p) {
        grid.mesh.points[p].x() += most * unit();
        grid.mesh.points[p].y() += most * unit();
    }
}

} // namespace lacuna::test
