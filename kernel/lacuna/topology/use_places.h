// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::topology {

/// Points along uses that follow each other, both ends included; where two uses meet once. `use_points()` of
/// model.h gives those of a single use.
/// @pre  uses is not empty.
std::vector<Index> use_points(const Model& model, const std::vector<EdgeUse>& uses);

/// Those of a closed loop: its first point is not repeated. None for no uses.
std::vector<Index> loop_points(const Model& model, const std::vector<EdgeUse>& uses);

/// Where those points are.
std::vector<Vec3> places_at(const Model& model, const std::vector<Index>& points);
std::vector<Vec3> use_places(const Model& model, EdgeUse use);
std::vector<Vec3> use_places(const Model& model, const std::vector<EdgeUse>& uses);
std::vector<Vec3> loop_places(const Model& model, const std::vector<EdgeUse>& uses);

} // namespace lacuna::topology
