// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::topology {

/// Largest tolerance of loading, as a share of the diagonal: a larger one would join separate parts.
inline constexpr double kMostTolerance = 0.01;

/// Two free edges that are close to each other and belong to unconnected parts of a model.
struct Gap {
    EdgeId own, other;
    double width = kInfinity; ///< largest distance of a point of `own` from other parts [model length]
};

/// The gaps between free edges of unconnected parts that are narrow enough to be sewn; the narrowest first,
/// each pair of edges once. Gaps within one part are not searched.
/// @throw Cancelled
/// @note  O(n log n log parts) in the number n of points on free edges.
std::vector<Gap> gaps(const Model& model, const RunContext& context = {});

/// The loading tolerance that sews a gap: its width rounded up to two digits, with a margin for the rounding
/// of coordinates [model length].
double sewing_tolerance(const Model& model, const Gap& gap);

} // namespace lacuna::topology
