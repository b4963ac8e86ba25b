// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/matching/detail/alignment.h>

#include <optional>
#include <vector>

namespace lacuna::matching {

/// An assignment of source loops to target loops. It follows from the alignment of one source loop, the
/// anchor.
struct Arrangement {
    std::vector<int> target; ///< by source loop: its target loop
    int anchor = 0;
    Alignment alignment;           ///< alignment of the anchor; its score includes the misfit of the other
                                   ///< loops
    std::optional<Alignment> next; ///< the second best alignment with the same pairs
    double score = kInfinity;
};

/// Pair the loops. Every alignment of the anchor with each allowed target loop is tried; its score includes
/// how well the other loops, moved in the same way, fit target loops.
/// @return the two best arrangements with different pairs, best first.
std::vector<Arrangement> arrange(const Problem& problem);

} // namespace lacuna::matching
