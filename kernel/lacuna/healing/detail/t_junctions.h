// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::healing {

/// A facet, or a piece of a cut facet.
struct FacetPiece {
    Triangle corner;
    Index of = -1;
};

/// Cut facets at T-junctions: where a point of a free side lies within the tolerance of another free side,
/// away from that side's ends. Free side: a side of only one facet.
///
/// @param whole  by facet: whether it must not be cut, such as halves of given quads.
/// @return  the facets in their order, with the pieces of a cut facet in its place; empty if no facet is cut.
/// @throw Cancelled
/// @note O(n), plus O(n log n) in the free sides.
std::vector<FacetPiece> cut_at_t_junctions(std::span<const Vec3> points, std::span<const Triangle> facets,
                                           const std::vector<bool>& whole, double tolerance,
                                           const RunContext& context);

} // namespace lacuna::healing
