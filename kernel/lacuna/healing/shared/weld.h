// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::healing {

/// For each point, the index of the point into which it merges: its own, or that of an earlier point within
/// `tolerance`.
///
/// Points are visited in order. A point merges into the nearest kept point within the tolerance (of several
/// at the same distance, the first); if there is none, the point is kept. Hence result[result[i]] ==
/// result[i] <= i, and kept points are further apart than the tolerance. Equal points always merge.
/// @pre  every coordinate is finite; tolerance >= 0.
/// @throw Cancelled.
/// @note O(n) unless kept points are much closer to each other than the tolerance.
std::vector<Index> weld(std::span<const Vec3> points, double tolerance, const RunContext& context = {});

} // namespace lacuna::healing
