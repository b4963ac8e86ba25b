// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/partial_mesh.h>

#include <optional>

namespace lacuna::quads::paving {

/// Fill the area between loops with quads. Holes are first joined to the outer loop. The joined loop is then
/// cut in two recursively, until every part is a good patch or a loop of at most six nodes.
/// @return whether `fill_patch()` filled the area as one patch, without a cut. Empty if no line joins a hole
///         to the outer loop, or no line cuts a part; the area is then not filled.
/// @pre   the total number of nodes of the loops is even.
/// @throw Cancelled  by the context.
std::optional<bool> fill_core(PartialMesh& partial, const std::vector<Cycle>& loops,
                              const RunContext& context);

} // namespace lacuna::quads::paving
