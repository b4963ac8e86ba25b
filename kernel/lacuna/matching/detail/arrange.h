// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/matching/detail/alignment.h>

#include <optional>
#include <vector>

namespace lacuna::matching {

/// An assignment of source loops to target loops that follows from the alignment of one of them, the anchor.
struct Arrangement {
    std::vector<int> target; ///< by source loop: its target loop
    int anchor = 0;
    Alignment alignment;           ///< of the anchor; its score includes the misfit of the other loops
    std::optional<Alignment> next; ///< the second best alignment with the same pairs
    double score = kInfinity;
};

/// Pair the loops: try every alignment of one source loop with each allowed target loop, and rate where it
/// places the other loops.
/// @return the two best arrangements with different pairs, best first.
std::vector<Arrangement> arrange(const Problem& problem);

} // namespace lacuna::matching
