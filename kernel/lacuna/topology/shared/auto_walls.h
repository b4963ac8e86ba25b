// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::topology {

/// Walls found for given ends.
struct WallChoice {
    std::vector<FaceId> walls;    ///< ascending
    std::vector<FaceId> left_out; ///< connected to the ends, but bounding another void or none; ascending
    /// For each face left out: one of its edges that two faces of the volume already use.
    std::vector<EdgeId> taken;
    /// Whether the end is inside a cavity of a solid. The walls are then the other faces of the cavity.
    bool of_cavity = false;
    std::vector<FaceId> more_of_end; ///< flat faces of this cavity with the end's normal: part of the end
    /// Flat faces of this cavity with the opposite normal: part of the other end.
    std::vector<FaceId> more_of_other;
};

/// Find the walls of a void from its ends: the faces connected to the rim of `source`, or of `target` if
/// `source` is empty, over shared edges without crossing the other end.
///
/// If the end is inside a cavity of a closed skin (`cavity_round()`), the walls are the other faces of this
/// cavity. Those of them that are flat and have the end's normal, such as a ledge or the top of a post,
/// become part of the end. Those with the opposite normal, such as the underside of a board on posts,
/// become part of the other end. Notes say so.
///
/// A void has at most two faces at each edge. If more than two of the connected faces share an edge, some of
/// them must be left out. Sheet: a set of faces connected by edges that no other faces use. Each sheet is
/// taken or left out as a whole. Choice: a set of sheets to which no other sheet can be added. Choices are
/// ranked in this order:
/// 1. If an end is missing, the choice must have free edges for this end.
/// 2. The length of its free edges is minimal.
/// 3. The enclosed volume is minimal, because the faces nearest to the void are its walls.
///
/// All faces are taken if there are too many choices to enumerate, if a sheet and the ends together use an
/// edge more than twice, or if no choice is valid.
/// @throw InvalidInput "topology.walls_ambiguous"  two choices are equally good; names both.
/// @throw Cancelled
/// @note  O(faces) if no edge is used more than twice; otherwise exponential in the number of sheets, up to a
///         bound.
WallChoice find_walls(const Model& model, const std::vector<FaceId>& source,
                      const std::vector<FaceId>& target, const RunContext& context = {});

} // namespace lacuna::topology
