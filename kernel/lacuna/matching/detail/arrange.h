// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/detail/alignment.h>

#include <limits>
#include <optional>
#include <vector>

namespace lacuna::matching {

/// Source loops on target loops, all led by how one of them, the anchor, is aligned.
struct Arrangement {
    std::vector<int> target; ///< of each source loop
    int anchor = 0;
    Alignment alignment;           ///< of the anchor; its score counts where the other loops land
    std::optional<Alignment> next; ///< the second best with the same pairs
    double score = std::numeric_limits<double>::infinity();
};

/// Pair the loops: align one source loop with each target loop it may go to, in every way, and see how the
/// others fall.
/// @return the two best arrangements with different pairs, best first.
std::vector<Arrangement> arrange(const Problem& problem);

} // namespace lacuna::matching
