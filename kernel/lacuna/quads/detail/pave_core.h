// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/partial_mesh.h>

namespace lacuna::quads::paving {

/// Fill what lies between loops with quads. Holes are joined to the outer loop; then the loop is cut in two
/// again and again, until every part is a good patch or a loop of six nodes or fewer.
/// @param one_patch  the only loop is filled without a cut, if there is a template for it at all.
/// @return whether all was filled by `fill_patch()` as one part, without a cut.
/// @pre   the loops have an even number of nodes in sum.
/// @throw Cancelled  by the context.
bool fill_core(PartialMesh& partial, const std::vector<Cycle>& loops, bool one_patch,
               const RunContext& context);

} // namespace lacuna::quads::paving
