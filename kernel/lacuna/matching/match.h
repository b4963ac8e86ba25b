// SPDX-License-Identifier: MIT
#pragma once

// In: an open volume with both ends; out: pairs of its source and target loops and vertices, and splits of
// edges.
//
// Where to change things:
//   steps of match()                      match.cpp
//   pairs that walls and the user fix     problem.cpp
//   chains of wall edges from rim to rim  side_lines.cpp
//   sections of the walls                 guides.cpp
//   which loops are paired                arrange.cpp, assignment.cpp
//   fit of one loop onto another          alignment.cpp; its sample points: loop_shape.cpp
//   which vertices are paired             arc_pairs.cpp; method "nearest": nearest.cpp
//   corners of a loop                     corners.cpp
//   splits that make a partner            splits.cpp

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

/// Parts of a match that the user fixes. Parts that are left empty are computed. Loop numbers count from 0.
struct MatchOptions {
    Method method = Method::aligned;
    std::vector<std::pair<int, int>> vertices; ///< (source, target) vertex tags
    std::vector<std::pair<int, int>> loops;    ///< (source, target) loop numbers
    std::vector<int> flip;                     ///< source loops whose computed direction on the target is
                                               ///< reversed
    friend bool operator==(const MatchOptions&, const MatchOptions&) = default;
};

/// A source loop and the target loop to which it is swept.
struct LoopPair {
    int source = -1, target = -1;
    bool flipped = false; ///< whether the target loop is traversed against its own direction
};

/// A split of an edge of one end. It makes a partner for a vertex of the other end.
struct Split {
    VertexId vertex;
    bool on_target = true; ///< true: `edge` belongs to the target and `vertex` to the source; false: the
                           ///< reverse
    EdgeId edge;
    double fraction = 0; ///< place of the split, as a share of the edge's length from its start
};

/// Correspondence of loops and vertices between source and target (Algorithm 1).
struct Match {
    std::vector<topology::Rim> source_loops, target_loops;
    std::vector<LoopPair> loops;
    std::vector<std::pair<VertexId, VertexId>>
        vertices;              ///< (source, target), in the order of the source loops and of the vertices
                               ///< along each of them
    std::vector<bool> hard;    ///< by vertex pair: whether walls or the user fixed the pair
    std::vector<Split> splits; ///< vertices that apply_splits() has yet to create
    std::string method;
    double confidence = 1; ///< 1 − best residual / second best residual, in [0, 1]; 1 if there is no second
                           ///< possibility
    std::vector<Message> notes;
    /// side_lines() of the volume when it was matched; empty if match() did not make this match.
    std::optional<std::vector<SideLine>> side_lines;
};

/// Match the rims of source and target.
///
/// This is Algorithm 1 of the paper (docs/bibliography.md). Method `aligned` (default) keeps the vertex pairs
/// that walls join and assigns the loops to each other. It then pairs the other vertices of two loops by the
/// cyclic shift and direction with the best rigid fit. Method `nearest` pairs nearest vertices, as in the
/// paper.
///
/// `aligned` pairs the vertices of two loops by arc length (pair_by_arc()) in these cases:
/// - the loops have different numbers of vertices, or one vertex each;
/// - no shift keeps the pairs that walls join;
/// - a corner would be paired with a smooth vertex, although a corner is available;
/// - no two corners are paired, and void edges would be twisted by more than 1/32 of the loop.
///
/// Smooth vertex: the loop does not turn there. Corners that are on no wall always get a partner, if
/// necessary by a split of an edge of the other loop; smooth vertices may stay without a partner.
/// @throw InvalidInput  a pair or loop that the user fixed contradicts the faces.
/// @throw NotClosed  the ends have different numbers of loops, or fixed parts contradict each other; names
///         them.
/// @throw Cancelled
Match match(const topology::OpenVolume& volume, const MatchOptions& options = {},
            const RunContext& context = {});

/// A volume and its match. All splits have been made: `Match::splits` is empty.
struct Matched {
    topology::OpenVolume volume;
    Match match;
};

/// Make the splits of a match by topology::split_edge(). A split is skipped, with a note, if the edge has a
/// wall, or if the place is at an end of the edge or inside a quad side of a given mesh.
/// @pre the match is of this volume.
Matched apply_splits(topology::OpenVolume volume, Match match);

} // namespace lacuna::matching
