// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

/// Loops of a plane region. Internal to this folder.
namespace lacuna::surface {

/// Signed area of a loop of points; > 0 if it runs counter-clockwise.
double signed_area(std::span<const Vec2> points, std::span<const Index> loop);

/// Sort the outer loop first, as the planar meshers require.
void sort_outer_first(std::span<const Vec2> points, std::vector<std::vector<Index>>& loops);

} // namespace lacuna::surface
