// SPDX-License-Identifier: MIT
#pragma once

/// Shared by the parts of the paver: the mesh under construction, cycles of its nodes, angles along them.
/// Only sources of this folder include it.

#include <lacuna/core/shared/edge_key.h>
#include <lacuna/quads/detail/region_loops.h>

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace lacuna::quads::paving {

/// Weights of the terms of a cut's cost. No weights are best for all outlines, so small regions are cut with
/// several sets of weights.
struct CutWeights {
    /// Deviation of the angles at the cut's ends from multiples of a right angle.
    double corners = 1;
    double added = 1;         ///< number of quads that the cut adds at its end nodes
    double length = 1;        ///< length of the cut relative to the outline that it cuts off
    double mismatch = 1;      ///< unequal numbers of opposite sides in the parts
    double bent = 0.5;        ///< bonus for a cut that ends where the outline turns inward
    double least_patch = 0.6; ///< quality from which a part is filled without a cut [-]
};

/// The mesh under construction. The first `fixed` points are the region's own.
struct PartialMesh {
    std::vector<Vec2> points;
    std::vector<Quad> quads;
    std::size_t fixed = 0;
    SizeField size;
    double flat = 0; ///< a quad counts as folded if the sine of a corner is smaller than this [-]
    /// Edges drawn between existing nodes. Two edges between the same two nodes would make the mesh invalid.
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
