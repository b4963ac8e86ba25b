// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/matching/side_lines.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lacuna::matching {

enum class Method { aligned, nearest };

/// Parts of a match a person forces; what is left empty is found. Numbers count from 0.
struct MatchOptions {
    Method method = Method::aligned;
    std::vector<std::pair<int, int>> vertices; ///< (source, target) vertex tags
    std::vector<std::pair<int, int>> loops;    ///< (source, target) loop numbers
    std::vector<int> flip;                     ///< source loops whose direction on the target is turned round
    friend bool operator==(const MatchOptions&, const MatchOptions&) = default;
};

/// A source loop and the target loop it is swept to.
struct LoopPair {
    int source = -1, target = -1;
    bool flipped = false; ///< the target loop has to be walked against its own direction
};

/// A vertex of one end that has no partner on the other: an edge there is to be split to make one.
struct Split {
    VertexId vertex;
    bool on_target = true; ///< the edge is the target's, the vertex the source's; else the other way round
    EdgeId edge;
    double fraction = 0; ///< of the edge's length, as it runs
};

/// Which loop and vertex of the source goes to which of the target (Algorithm 1).
struct Match {
    std::vector<topology::Rim> source_loops, target_loops;
    std::vector<LoopPair> loops;
    std::vector<std::pair<VertexId, VertexId>>
        vertices;              ///< (source, target), source loop by source loop in walking order
    std::vector<bool> hard;    ///< of each vertex pair: joined by a chain of wall edges
    std::vector<Split> splits; ///< vertices still to be made: apply_splits()
    std::string method;
    double confidence = 1; ///< 0…1: 1 − best / second best residual; 1 where nothing had to be guessed
    std::vector<std::string> notes;
    /// side_lines() of the volume as it was matched; nothing where the match was not found by match().
    std::optional<std::vector<SideLine>> side_lines;
};

/// Match the rims of source and target.
///
/// Algorithm: paper's Algorithm 1. `aligned` (default): hard pairs from the walls, loops by assignment,
/// vertices by the rigid fit of every cyclic shift and direction. `nearest`: the paper's own vertex
/// distances.
///
/// `aligned` pairs vertices by how far along the loops they stand, pair_by_arc(), where the vertices
/// themselves do not tell: loops with unlike numbers of them, closed edges, loops without corners whose
/// vertices would turn the void edges by more than 1/32 of the loop, and those where a corner would meet no
/// corner; choose_how(). Real corners get a partner always, by a split of the other loop if need be; a vertex
/// that only says where a smooth run was cut may stay alone.
/// @throw InvalidInput   a forced part that contradicts the faces.
/// @throw NotClosed      loops that differ in number; forced parts that contradict each other; names them.
/// @throw Cancelled
Match match(const topology::OpenVolume& volume, const MatchOptions& options = {},
            const RunContext& context = {});

/// Make the splits a match wants, by topology::split_edge(): its pairs and loops are whole then, and no
/// splits are left. A place on an edge with a wall is passed over, with a note.
/// @pre the match is of this volume.
void apply_splits(topology::OpenVolume& volume, Match& match);

} // namespace lacuna::matching
