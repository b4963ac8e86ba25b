// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/match.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::matching {

/// What is settled before distances are measured: by walls, or by hand.
struct NearestInput {
    std::vector<topology::Rim> source_loops, target_loops; ///< as many
    std::map<VertexId, VertexId> fixed;                    ///< source vertex → target vertex
    std::vector<int> loops;                                ///< target loop of each source loop, -1: open
    std::vector<bool> turned;     ///< source loops to be laid the other way round than found
    std::optional<bool> opposite; ///< rims run opposite ways (joined by walls), or alike; empty: not known
};

struct NearestMatch {
    std::vector<LoopPair> loops;
    std::vector<std::pair<VertexId, VertexId>> vertices; ///< source loop by source loop in walking order
    /// 1 − mean distance / mean distance to the second nearest; no more than the share of vertices that
    /// agree.
    double confidence = 1;
    std::vector<std::string> notes;
};

/// Algorithm 1 as the paper has it: vertices go to the nearest.
///
/// Steps 4 to 7 of the paper, each its own function in the source; 1 to 3 are the caller's. Where the paper
/// is silent: of equal distances the first counts; pairs compete for a vertex by distance; the direction of
/// loops of one or two vertices is that of their areas. The share within two standard deviations of the mean,
/// which step 7 wants to be a half, is three quarters at least for any numbers (Chebyshev); so outliers and
/// vertices left over are matched better whenever there are any: by the shift and direction that most
/// vertices of their loop agree on, which must be half of them.
/// @throw NotClosed  loops with unlike numbers of edges; loops or vertices for which distances give no
///         one-to-one map that keeps the order along the loops; names them.
NearestMatch match_nearest(const topology::Model& model, const NearestInput& input,
                           const RunContext& context);

} // namespace lacuna::matching
