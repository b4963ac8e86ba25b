// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::topology {

/// The walls that go with some ends.
struct WallChoice {
    std::vector<FaceId> walls;    ///< rising
    std::vector<FaceId> left_out; ///< reachable from the ends, but bounding another void or none; rising
    /// Of each face left out an edge that two faces of the volume use already.
    std::vector<EdgeId> taken;
    bool of_cavity = false; ///< the walls are what else bounds the cavity of a solid that the end lies in
    std::vector<FaceId> more_of_end; ///< of that cavity the flat faces that face as the end does
};

/// The walls of a void, found from its ends: the faces that can be reached from the rim of `source`, or where
/// it is empty of `target`, over shared edges and not over the other end.
///
/// An end in a cavity of a closed skin, by cavity_round(), has the other faces of that cavity. Those that
/// face as a flat end does are no walls but parts of it, as a ledge and the top of a post; a note says so.
///
/// No edge bounds one void with more than two faces. Where more than two of the faces reached share an edge,
/// those that hang together by other edges are taken or left together. Of all choices to which nothing can be
/// added, the one with the least length of free edges is taken, and of those as good the one that encloses
/// least: the first faces round the void, not those round its neighbours. With one end, free edges have to
/// remain for the other. Where so many faces meet so often that the choices cannot be counted, where faces
/// lead round to an edge they left from, and where no choice passes, all are taken.
/// @throw InvalidInput "topology.walls_ambiguous"  two choices as good as each other; names both. Cancelled.
/// @note  O(faces) where no edge is used more than twice; else exponential in the groups of faces that meet,
///        up to a bound.
WallChoice find_walls(const Model& model, const std::vector<FaceId>& source,
                      const std::vector<FaceId>& target, const RunContext& context = {});

} // namespace lacuna::topology
