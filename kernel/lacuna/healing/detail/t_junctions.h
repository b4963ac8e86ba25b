// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::healing {

/// A facet, and the one it is, or is a piece of, in the list it comes from.
struct FacetPiece {
    Triangle corner;
    Index of = -1;
};

/// Cut facets where points lie on the inside of their sides (T-junctions): a side of one facet alone, and a
/// point of such a side, within the tolerance of each other.
///
/// @param whole  facets that must not be cut, as halves of quads that are kept.
/// @return the facets in their order, pieces in the place of what was cut; nothing where none was.
/// @throw Cancelled
/// @note O(n) and, in the sides of one facet alone, O(n log n).
std::vector<FacetPiece> cut_at_t_junctions(std::span<const Vec3> points, std::span<const Triangle> facets,
                                           const std::vector<bool>& whole, double tolerance,
                                           const RunContext& context);

} // namespace lacuna::healing
