// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <limits>
#include <vector>

namespace lacuna::topology {

/// Free edges of two parts of a model that run beside each other and are not sewn.
struct Gap {
    EdgeId own, other;
    double width = std::numeric_limits<double>::infinity(); ///< at its widest [model length]
};

/// The gaps between the free edges of parts that share no edges, narrow enough to be sewn; the narrowest
/// first, each pair of edges once. Gaps within one part are not looked for.
/// @throw Cancelled
/// @note  O(n log n log parts) of n points on free edges.
std::vector<Gap> gaps(const Model& model, const RunContext& context = {});

/// The tolerance of loading that sews a gap: its width rounded up to two digits, with room for the rounding
/// of coordinates [model length].
double sewing_tolerance(const Model& model, const Gap& gap);

} // namespace lacuna::topology
