// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// Add missing round walls between free loops: the wall of a bore, of a shaft or of a cone between two rims
/// on one axis.
///
/// A rim needs such a wall if a flat face in it would lie in the plane of the given faces round it, or if it
/// is not planar and these faces do not continue the wall. Rims on one axis with equal radii are paired along
/// it; a rim left over is paired with one that a flat face might close as well. Rims of two unconnected parts
/// are paired too.
/// @return  the free loops that are left.
std::vector<topology::Rim> add_tubes(FlatFilling& filling, std::vector<topology::Rim> loops,
                                     const RunContext& context);

/// A face on the circular cylinder or cone through an arc of its rim and all of the rim, which does not run
/// round the axis. The facets are laid on the unrolled surface.
/// @return  empty if the rim lies on no such surface.
std::optional<VoidFilling> fill_round_patch(const topology::Model& model, const topology::Loop& loop,
                                            const RunContext& context);

} // namespace lacuna::closure
