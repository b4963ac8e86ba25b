// SPDX-License-Identifier: MIT
#pragma once

/// What the parts of the paver share: the mesh while it is built, cycles of its nodes, angles along them.
/// Only sources of this folder include it.

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/quads/detail/region_loops.h>

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace lacuna::quads::paving {

/// A boundary node with a smaller angle is a corner of one quad: half way from a right angle to a straight
/// one.
inline constexpr double kCornerBelow = 1.5 * kRightAngle;
/// With a larger one the outline turns inward: half way from a straight angle to a corner of three quads.
inline constexpr double kBentAbove = 2.5 * kRightAngle;

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
    SizeField size;
    double flat = 0; ///< quads with a smaller sine count as folded [-]
    /// Single edges drawn between nodes that were there before. A second one between the same two nodes would
    /// make no valid mesh.
    std::unordered_set<std::uint64_t> links{};
    CutWeights weights{};

    void link(Index a, Index b) { links.insert(edge_key(a, b)); }
    [[nodiscard]] bool linked(Index a, Index b) const { return links.contains(edge_key(a, b)); }

    [[nodiscard]] const Vec2& at(Index p) const { return points[index(p)]; }
    [[nodiscard]] bool is_fixed(Index p) const { return index(p) < fixed; }
    Index add(const Vec2& p)
    {
        points.push_back(p);
        return static_cast<Index>(points.size()) - 1;
    }
};

using quads::least_sine;

/// Least sine of a quad's corners.
inline double least_sine(const PartialMesh& partial, const Quad& q)
{
    return least_sine(partial.at(q[0]), partial.at(q[1]), partial.at(q[2]), partial.at(q[3]));
}

} // namespace lacuna::quads::paving
