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
/// Cut surfaces are the planes of flat faces beside concave edges, each only as far as it reaches from these
/// edges into the volume. In each step the piece with the most concave edges is cut where that leaves the
/// least length of concave edges in pieces without ends to sweep between. Ends are those of `read_ends()`,
/// or of the directions in which the closed skin can be swept, if `can_sweep` agrees. Cutting stops where no
/// cut reduces that length. If a piece is left without ends, the volume is cut in steps instead, between all
/// flat faces that face along an axis (`cut_steps()`), or divided at its middle (`midpoint_blocks()`), or if
/// that is not possible either, each piece without ends is.
/// @return  pieces with their ends; those without ends cannot be swept. The volume itself if no cut helps.
/// @note  At most 200 cuts are tried, and 64 pieces made. O(facets log facets) for each cut.
std::vector<StepPiece> partition(const topology::OpenVolume& volume, const CanSweep& can_sweep,
                                 const RunContext& context = {});

/// Whether a piece has a source and a target.
bool has_ends(const topology::OpenVolume& piece);

} // namespace lacuna::closure
