// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::closure {

/// Divide rounds between an end and walls that lead away from the opposite end, such as the fillet round the
/// top of a product in a box. They are divided where they are inclined by 45 degrees. The flatter part
/// becomes part of the end, so that the rim of the step is there and layers meet the walls below at 45
/// degrees or more. Undivided, the round would be tangent to the layers.
///
/// The dividing plane is normal to the direction of the end: facets on one side of it are flatter, on the
/// other side steeper. A round that the plane does not divide all round is left as it is.
/// The skin is oriented away from the void.
/// @note  O(facets) for each part of the ends that has such rounds.
void split_round_rims(topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
