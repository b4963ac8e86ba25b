// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <functional>
#include <vector>

namespace lacuna::closure {

/// Whether the walls of a sealed volume can be meshed between its ends.
using CanSweep = std::function<bool(const topology::OpenVolume&)>;

/// Cut a sealed volume that no single sweep fills into pieces that can be swept.
///
/// Cut surfaces are those of `cut_planes()`: planes of flat faces beside concave edges, each only as far as
/// it reaches from these edges into the volume, planes between features, and planes through the axes of
/// crossing bores. A piece is cut where that leaves the least length of bends, beyond those that one sweep
/// follows, in pieces without ends to sweep between, and these are cut in turn. Ends are those of
/// `read_ends()`, or of the directions in which the closed skin can be swept, if `can_sweep` agrees. Cutting
/// stops where no cut reduces that length, and cuts that do not help any piece are undone. If a piece is left
/// without ends, the volume is made one piece whose rounds at the rims of its ends are divided where they
/// are as steep as flat, or cut in steps between all flat faces that face along an axis (`cut_steps()`), or
/// divided at its middle (`midpoint_blocks()`), or if that is not possible either, each piece without ends
/// is.
/// @return  pieces with their ends; those without ends cannot be swept. The volume itself if no cut helps.
/// @note  At most 200 cuts are tried, and 64 pieces made. O(facets log facets) for each cut.
std::vector<StepPiece> partition(const topology::OpenVolume& volume, const CanSweep& can_sweep,
                                 const RunContext& context = {});

/// Whether a piece has a source and a target.
bool has_ends(const topology::OpenVolume& piece);

} // namespace lacuna::closure
