// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/shared/face_parts.h>

#include <vector>

namespace lacuna::topology {

/// The use of the same edge in the other direction.
constexpr EdgeUse opposite(EdgeUse use) { return {use.edge, !use.reversed}; }

/// Summed length of the edges [model length].
double length_of(const Model& model, const std::vector<EdgeUse>& uses);

/// Points along consecutive uses, both ends included. A point where two uses meet is listed once.
/// @pre  uses is not empty.
std::vector<Index> use_points(const Model& model, const std::vector<EdgeUse>& uses);

/// Points of a closed loop: the first is not repeated. Empty for no uses.
std::vector<Index> loop_points(const Model& model, const std::vector<EdgeUse>& uses);

/// Coordinates of the points that the functions above return.
std::vector<Vec3> places_at(const Model& model, const std::vector<Index>& points);
std::vector<Vec3> use_places(const Model& model, EdgeUse use);
std::vector<Vec3> use_places(const Model& model, const std::vector<EdgeUse>& uses);
std::vector<Vec3> loop_places(const Model& model, const std::vector<EdgeUse>& uses);

} // namespace lacuna::topology
