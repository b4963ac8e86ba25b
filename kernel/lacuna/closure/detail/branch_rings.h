// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/branch_mouths.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut all tubes that lead from mouth to mouth across, midway between the centres of their mouths, if tubes
/// close a ring, such as the rungs between two headers. A cut at one mouth of a ring would divide nothing.
/// @return  empty if there is no ring
std::vector<StepPiece> cut_rings(const topology::OpenVolume& volume, const Branching& found,
                                 const RunContext& context);

} // namespace lacuna::closure
