// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/match.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::matching {

/// Pairs fixed by walls or by the user before distances are measured.
struct NearestInput {
    std::vector<topology::Rim> source_loops, target_loops; ///< the same number of loops
    std::map<VertexId, VertexId> fixed;                    ///< source vertex → target vertex
    std::vector<int> loops;                                ///< target loop of each source loop, -1: not fixed
    std::vector<bool> turned;                              ///< source loops whose direction the user reverses
    std::optional<bool> opposite; ///< rims run in opposite directions (joined by walls), or alike; empty:
                                  ///< unknown
};

struct NearestMatch {
    std::vector<LoopPair> loops;
    std::vector<std::pair<VertexId, VertexId>> vertices; ///< source loop by source loop in walking order
    /// 1 − mean distance / mean distance to the second nearest; at most the share of vertices that agree.
    double confidence = 1;
    std::vector<std::string> notes;
};

/// Algorithm 1 as in the paper: each vertex is paired with the nearest.
///
/// Steps 4 to 7 of the paper, one function each; the caller does 1 to 3. Where the paper is silent: the first
/// of equal distances wins; pairs compete for a vertex by distance; loops of one or two vertices take their
/// direction from their area vectors. Step 7 requires half of the distances to be within two standard
/// deviations of the mean, but by Chebyshev at least three quarters always are. So whenever there are
/// outliers or unpaired vertices, they are paired by the shift and direction that most vertices of their loop
/// agree on, at least half of them.
/// @throw NotClosed  loops with different numbers of edges; loops or vertices whose distances give no
///         one-to-one map that keeps the order along the loops; names them.
NearestMatch match_nearest(const topology::Model& model, const NearestInput& input,
                           const RunContext& context);

} // namespace lacuna::matching
