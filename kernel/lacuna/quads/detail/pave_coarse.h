// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/region_loops.h>
#include <lacuna/quads/shared/pave.h>

#include <optional>

namespace lacuna::quads::paving {

/// Pave the coarse region, cut its cells in four and smooth the quads. A large coarse region is itself
/// coarsened first.
/// @param size  size in the region, graded from its boundary sides.
/// @return empty if there is no coarse region or it cannot be filled.
/// @throw Cancelled
std::optional<Paved> pave_in_four(const PlanarRegion& region, const SizeField& size,
                                  const RunContext& context);

} // namespace lacuna::quads::paving
