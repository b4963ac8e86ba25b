// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <span>
#include <vector>

/// Loops of a plane region. Internal to this folder.
namespace lacuna::surface {

/// Area that a loop of points encloses; > 0 where it runs anticlockwise.
double signed_area(std::span<const Vec2> points, std::span<const Index> loop);

/// The outer loop first, as the planar meshers want it.
void sort_outer_first(std::span<const Vec2> points, std::vector<std::vector<Index>>& loops);

} // namespace lacuna::surface
