// SPDX-License-Identifier: MIT
#pragma once

/// What the parts of the paver share: the mesh while it is built, cycles of its nodes, angles along them.
/// Only sources of this folder include it.

#include <lacuna/core/shared/edge_key.h>
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
/// A boundary node with a smaller angle is a corner of one quad: half way from a right angle to a straight
/// one.
inline constexpr double kCornerBelow = 1.5 * kRightAngle;
/// With a larger one the outline turns inward: half way from a straight angle to a corner of three quads.
inline constexpr double kBentAbove = 2.5 * kRightAngle;

/// Node numbers in walking order, the region on the left. A node may occur twice where a cut was drawn.
using Cycle = std::vector<Index>;

/// What a cut costs, by weights. No weights are best for all outlines, so small regions are cut by several.
struct CutWeights {
    double corners = 1;       ///< of angles at its ends that are no right ones
    double added = 1;         ///< of the quads it adds at its ends
    double length = 1;        ///< of its length over that of the outline it takes off
    double mismatch = 1;      ///< of parts whose sides do not agree
    double bent = 0.5;        ///< gained by ending where the outline turns inward
    double least_patch = 0.6; ///< quality from which a small part is filled without a cut [-]
    double most_patch = 0.9;  ///< and a large one [-]
};

/// The mesh while it is built. The first `fixed` points are the region's own.
struct PartialMesh {
    std::vector<Vec2> points;
    std::vector<Quad> quads;
    std::size_t fixed = 0;
    std::function<double(const Vec2&)> size;
    double flat = 0; ///< quads with a smaller sine count as folded [-]
    /// Single edges drawn between nodes that were there before. A second one between the same two nodes would
    /// make no valid mesh.
    std::unordered_set<std::uint64_t> links{};
    CutWeights weights{};

    void link(Index a, Index b) { links.insert(edge_key(a, b)); }
    [[nodiscard]] bool linked(Index a, Index b) const { return links.contains(edge_key(a, b)); }

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

/// Angle inside the region at a position of the cycle [radians].
inline double inner_angle(const PartialMesh& partial, const Cycle& cycle, std::size_t i)
{
    const std::size_t n = cycle.size();
    const Vec2& p = partial.at(cycle[i]);
    return turn_between(partial.at(cycle[(i + 1) % n]) - p, partial.at(cycle[(i + n - 1) % n]) - p);
}

/// How many quads suit an angle, at least one.
inline int quads_in(double angle) { return std::max(1, static_cast<int>(angle / kRightAngle + 0.5)); }

/// Twice the area within a cycle, > 0 where it runs counter-clockwise.
inline double twice_area(const PartialMesh& partial, const Cycle& cycle)
{
    double sum = 0;
    for (std::size_t i = 0, n = cycle.size(); i < n; ++i)
        sum += cross(partial.at(cycle[i]) - partial.at(cycle[0]),
                     partial.at(cycle[(i + 1) % n]) - partial.at(cycle[0]));
    return sum;
}

/// Least sine of a quad's corners.
inline double least_sine(const PartialMesh& partial, const Quad& q)
{
    return least_sine(partial.at(q[0]), partial.at(q[1]), partial.at(q[2]), partial.at(q[3]));
}

} // namespace lacuna::quads::paving
