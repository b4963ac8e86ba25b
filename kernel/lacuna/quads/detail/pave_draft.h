// SPDX-License-Identifier: MIT
#pragma once

/// What the parts of the paver share: the mesh being made, cycles of its nodes, angles along them.
/// Only sources of this folder include it.

#include <lacuna/quads/detail/corner_sine.h>
#include <lacuna/quads/region.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <unordered_set>
#include <vector>

namespace lacuna::quads::paving {

inline constexpr double kRightAngle = std::numbers::pi / 2;

/// Node numbers in walking order, region on the left. A node may occur twice, where a cut was drawn.
using Cycle = std::vector<Index>;

/// What cuts are chosen by, as weights: none is best for all regions, so that small ones are filled in several ways.
struct Taste {
    double corners = 1;       ///< right angles between a cut and the outline
    double added = 1;         ///< quads a cut adds at its ends
    double length = 1;        ///< of a cut against the outline it takes off
    double mismatch = 1;      ///< sides of a part that do not agree
    double bent = 0.5;        ///< off for a cut that ends where the outline turns inward
    double least_patch = 0.6; ///< from what quality on a small part is filled as it is [-]
    double most_patch = 0.9;  ///< and a large one
};

/// The mesh being made. The first `fixed` points are the region's own.
struct Draft {
    std::vector<Vec2> points;
    std::vector<Quad> quads;
    std::size_t fixed = 0;
    std::function<double(const Vec2&)> size;
    double flat = 0; ///< quads with a smaller sine count as folded
    /// Single edges drawn between nodes that were there before: a second one between the same two would be
    /// no mesh.
    std::unordered_set<std::uint64_t> links{};
    Taste taste{};

    static std::uint64_t link_key(Index a, Index b)
    {
        const auto [low, high] = std::minmax(a, b);
        return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(low)) << 32) |
               static_cast<std::uint32_t>(high);
    }
    void link(Index a, Index b) { links.insert(link_key(a, b)); }
    [[nodiscard]] bool linked(Index a, Index b) const { return links.contains(link_key(a, b)); }

    [[nodiscard]] const Vec2& at(Index p) const { return points[static_cast<std::size_t>(p)]; }
    [[nodiscard]] bool is_fixed(Index p) const { return static_cast<std::size_t>(p) < fixed; }
    Index add(const Vec2& p)
    {
        points.push_back(p);
        return static_cast<Index>(points.size()) - 1;
    }
};

using quads::cross;
using quads::least_sine;
using quads::turn_between;

/// Angle inside the region at a place of the cycle.
inline double inner_angle(const Draft& draft, const Cycle& cycle, std::size_t i)
{
    const std::size_t n = cycle.size();
    const Vec2& p = draft.at(cycle[i]);
    return turn_between(draft.at(cycle[(i + 1) % n]) - p, draft.at(cycle[(i + n - 1) % n]) - p);
}

/// How many quads an angle is right for, at least one.
inline int quads_in(double angle) { return std::max(1, static_cast<int>(angle / kRightAngle + 0.5)); }

/// Twice the area a cycle goes round, > 0 counter-clockwise.
inline double twice_area(const Draft& draft, const Cycle& cycle)
{
    double sum = 0;
    for (std::size_t i = 0, n = cycle.size(); i < n; ++i)
        sum += cross(draft.at(cycle[i]) - draft.at(cycle[0]),
                     draft.at(cycle[(i + 1) % n]) - draft.at(cycle[0]));
    return sum;
}

/// Least sine of a quad's corners.
inline double least_sine(const Draft& draft, const Quad& q)
{
    return least_sine(draft.at(q[0]), draft.at(q[1]), draft.at(q[2]), draft.at(q[3]));
}

} // namespace lacuna::quads::paving
