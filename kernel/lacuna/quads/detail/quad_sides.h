// SPDX-License-Identifier: MIT
#pragma once

/// What the pairing of triangles and the repair of quads share. Only sources of this folder include it.

#include <lacuna/quads/detail/quad_repair.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>

namespace lacuna::quads {

inline std::uint64_t side_key(Index a, Index b)
{
    const auto [low, high] = std::minmax(a, b);
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32) |
           static_cast<std::uint32_t>(high);
}

inline std::size_t corner_count(const Quad& cell) { return MixedMesh::is_triangle(cell) ? 3 : 4; }

inline std::size_t place_of(const Quad& cell, Index point)
{
    std::size_t k = 0;
    while (cell[k] != point) ++k;
    return k;
}

/// The one or two cells at every side.
class Sides {
public:
    explicit Sides(const MixedMesh& mesh)
    {
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) add(mesh.cells[c], static_cast<Index>(c));
    }
    void add(const Quad& cell, Index c)
    {
        for (std::size_t k = 0, n = corner_count(cell); k < n; ++k) {
            auto& both = cells_
                             .try_emplace(side_key(cell[k], cell[(k + 1) % n]), std::array<Index, 2>{-1, -1})
                             .first->second;
            both[both[0] < 0 ? 0 : 1] = c;
        }
    }
    void remove(const Quad& cell, Index c)
    {
        for (std::size_t k = 0, n = corner_count(cell); k < n; ++k) {
            auto& both = cells_.at(side_key(cell[k], cell[(k + 1) % n]));
            if (both[0] == c)
                both[0] = both[1];
            else if (both[1] != c)
                continue;
            both[1] = -1;
        }
    }
    [[nodiscard]] Index across(Index a, Index b, Index c) const
    {
        const auto found = cells_.find(side_key(a, b));
        if (found == cells_.end()) return -1;
        return found->second[0] == c ? found->second[1] : found->second[0];
    }

private:
    std::unordered_map<std::uint64_t, std::array<Index, 2>> cells_;
};

/// Sine of a corner of a quad, -1 where a side has no length.
inline double corner_sine(const MixedMesh& mesh, const Quad& q, std::size_t k)
{
    const Vec2 u = mesh.at(q[(k + 1) % 4]) - mesh.at(q[k]);
    const Vec2 v = mesh.at(q[(k + 3) % 4]) - mesh.at(q[k]);
    const double product = u.norm() * v.norm();
    return product > 0 ? (u.x() * v.y() - u.y() * v.x()) / product : -1;
}

/// Put another cell in the place of one whose sides are no longer listed.
inline void replace(MixedMesh& mesh, Sides& sides, Index c, const Quad& cell)
{
    sides.add(cell, c);
    mesh.cells[static_cast<std::size_t>(c)] = cell;
}

} // namespace lacuna::quads
