// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <array>
#include <functional>
#include <vector>

namespace lacuna::test {

using PlanMap = std::function<Vec2(double, double)>;       ///< of the unit square
using SpaceMap = std::function<Vec3(const Vec2&, double)>; ///< of plan and height, 0 source to 1 target

/// Four-sided piece of the plan, anticlockwise; facets of one source face. Its sides that no other has carry
/// walls: by names, so that one wall may stand on several; 0: a wall of its own.
struct PlanPatch {
    int face = 0;
    PlanMap at;
    std::array<int, 4> wall{};
};

/// A rectangle of the plan.
PlanMap rectangle(double x0, double y0, double x1, double y1);

/// The volume whose source, target and walls stand on the patches of a plan.
///
/// Patches meet along whole sides. All faces are facets; all target facets are one face.
/// @param facets  along each side of a patch
topology::OpenVolume prism_over(const std::vector<PlanPatch>& patches, const SpaceMap& map, int facets);

} // namespace lacuna::test
