// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>

#include <span>
#include <vector>

namespace lacuna::healing {

/// For each point the number of the point it becomes: itself, or an earlier one within `tolerance`.
///
/// Points are met in order; each joins the nearest earlier one that was kept and is within tolerance, the
/// first of equals, else is kept. So result[result[i]] == result[i] <= i, and points kept are further apart
/// than the tolerance. Equal points all become the same.
/// @pre  every coordinate is finite; tolerance >= 0.
/// @throw Cancelled.
/// @note O(n) where points kept are not much closer to each other than the tolerance.
std::vector<Index> weld(std::span<const Vec3> points, double tolerance, const RunContext& context = {});

} // namespace lacuna::healing
