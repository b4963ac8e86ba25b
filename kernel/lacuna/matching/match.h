// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/matching/side_lines.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::matching {

enum class Method { aligned, nearest };

/// Parts of a match that the user fixes; empty parts are computed. Numbers count from 0.
struct MatchOptions {
    Method method = Method::aligned;
    std::vector<std::pair<int, int>> vertices; ///< (source, target) vertex tags
    std::vector<std::pair<int, int>> loops;    ///< (source, target) loop numbers
    std::vector<int> flip;                     ///< source loops whose direction on the target is reversed
    friend bool operator==(const MatchOptions&, const MatchOptions&) = default;
};

/// A source loop and the target loop it is swept to.
struct LoopPair {
    int source = -1, target = -1;
    bool flipped = false; ///< the target loop is traversed against its own direction
};

/// A vertex of one end without a partner on the other end. An edge of the other end is split to make a
/// partner.
struct Split {
    VertexId vertex;
    bool on_target = true; ///< the edge is the target's and the vertex the source's; otherwise the reverse
    EdgeId edge;
    double fraction = 0; ///< of the edge's length, in the direction of the edge
};

/// Correspondence of loops and vertices between source and target (Algorithm 1).
struct Match {
    std::vector<topology::Rim> source_loops, target_loops;
    std::vector<LoopPair> loops;
    std::vector<std::pair<VertexId, VertexId>>
        vertices;              ///< (source, target), source loop by source loop in walking order
    std::vector<bool> hard;    ///< by vertex pair: fixed by walls or by the user
    std::vector<Split> splits; ///< vertices still to be created by apply_splits()
    std::string method;
    double confidence = 1; ///< 0…1: 1 − best / second best residual; 1 if there was only one possibility
    std::vector<Message> notes;
    /// side_lines() of the volume when it was matched; empty if match() did not make this match.
    std::optional<std::vector<SideLine>> side_lines;
};

/// Match the rims of source and target.
///
/// Algorithm: the paper's Algorithm 1. Method `aligned` (default) keeps the vertex pairs that walls join,
/// pairs the loops by an assignment, and pairs the other vertices by the best rigid fit over all cyclic
/// shifts and both directions. Method `nearest` uses the paper's own vertex distances.
///
/// `aligned` pairs vertices by arc length, pair_by_arc(), where a vertex-to-vertex pairing is not reliable.
/// This concerns loops with different numbers of vertices, loops with one vertex, loops without corners whose
/// vertices would twist the void edges by more than 1/32 of the loop, and loops where a corner would be
/// paired with a smooth vertex. Corners always get a partner, if necessary by splitting an edge of the other
/// loop; a vertex on a smooth run may stay without one.
/// @throw InvalidInput   a pair or loop fixed by the user that contradicts the faces.
/// @throw NotClosed      different numbers of loops; fixed parts that contradict each other; names them.
/// @throw Cancelled
Match match(const topology::OpenVolume& volume, const MatchOptions& options = {},
            const RunContext& context = {});

/// A volume and its match, whose pairs and loops are complete: `splits` is empty.
struct Matched {
    topology::OpenVolume volume;
    Match match;
};

/// Make the splits of a match by topology::split_edge(). A split is skipped, with a note, on an edge with a
/// wall, at an end of an edge, and inside a quad side of a given mesh.
/// @pre the match is of this volume.
Matched apply_splits(topology::OpenVolume volume, Match match);

} // namespace lacuna::matching
