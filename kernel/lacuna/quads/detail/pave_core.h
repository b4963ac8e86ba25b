// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quads/detail/pave_draft.h>

#include <cstddef>

namespace lacuna::quads::paving {

/// What filling by cuts took.
struct CoreCount {
    int patches = 0, cuts = 0, templates = 0;
};

/// Fill what lies between loops with quads: holes are joined to the outer loop, then the loop is cut in two
/// again and again until every part is a patch or a loop of six nodes or fewer.
/// @param one_patch  the only loop is to be filled as it is, if that goes at all.
/// @pre the loops' lengths are even in sum.
CoreCount fill_core(Draft& draft, const std::vector<Cycle>& loops, bool one_patch, const RunContext& context);

} // namespace lacuna::quads::paving
