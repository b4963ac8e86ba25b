// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/branch_mouths.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Cut all tubes without ends of their own that lead from one mouth to another, such as the rungs between two
/// headers, across midway between the centres of their mouths. Each body then has branches of its own. Where
/// tubes close a ring, a cut at a single mouth would not divide the volume.
/// @return  empty if there is no such tube
std::vector<StepPiece> cut_connecting_tubes(const topology::OpenVolume& volume, const Branching& found,
                                            const RunContext& context);

} // namespace lacuna::closure
