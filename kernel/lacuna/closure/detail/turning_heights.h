// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::closure {

/// Heights along an axis at which smooth parts of a skin turn over, from facing along the axis to facing
/// against it: the middle of a ball, a torus or an egg. Of a part that is parallel to the axis there, such as
/// a capsule, the height is that of the middle. Parts whose rims pass that height, such as bores across the
/// axis, do not count.
/// @note  O(facets log facets).
std::vector<double> turning_heights(const topology::Model& model, const Vec3& axis);

} // namespace lacuna::closure
