// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::closure {

/// Divide rounds between an end and walls that lead away from the opposite end, such as the fillet round the
/// top of a product in a box, where they are as steep as they are flat: what is flatter becomes a part of the
/// end, so that the rim of the step is there. Below it layers meet the walls at 45 degrees at least; without
/// it they would be tangent to them.
///
/// A round is divided by a plane across the end's own direction, so that its facets are flatter on one side
/// and steeper on the other; one that the plane does not part all round is left as it is.
/// @pre  the skin faces away from the void.
/// @note  O(facets) for each part of the ends that has such rounds.
void split_round_rims(topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
