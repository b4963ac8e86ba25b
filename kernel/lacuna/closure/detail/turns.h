// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <numbers>
#include <vector>

namespace lacuna::closure {

/// An end has a rim with its walls where they meet at more than half of a right angle [radians].
inline constexpr double kRimTurn = std::numbers::pi / 4;

/// By how much the skin turns towards the void over each edge between two faces, on average along it
/// [radians]: positive where the void has more than a straight angle there, 0 for free edges and seams.
///
/// Which side the void is on is told of each connected part of the skin by itself: the ends of a part see
/// the opposite end of another part or, where it lies within none, its own; else the facets face away from
/// their middle, or towards it where the part lies within another.
/// @note  O(facets · parts).
std::vector<double> concave_turns(const topology::OpenVolume& volume, const RunContext& context);

/// Turn the parts of the skin so that they face away from the void.
void face_away(topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
