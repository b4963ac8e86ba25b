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
    /// For each face left out, an edge that two faces of the volume already use.
    std::vector<EdgeId> taken;
    bool of_cavity = false; ///< the end is inside a cavity of a solid, and the walls are the cavity's other
                            ///< faces
    std::vector<FaceId> more_of_end;   ///< flat faces of that cavity with the same normal as the end
    std::vector<FaceId> more_of_other; ///< flat faces of that cavity with the opposite normal
};

/// Find the walls of a void from its ends: the faces connected to the rim of `source`, or of `target` if
/// `source` is empty, over shared edges without crossing the other end.
///
/// For an end inside a cavity of a closed skin, see cavity_round(), the walls are the other faces of that
/// cavity. Flat faces with the end's normal, such as a ledge or the top of a post, become part of the end,
/// and those with the opposite normal, such as the underside of a board on posts, part of the other end, with
/// a note.
///
/// A void has at most two faces at each edge. Where more than two connected faces share an edge, each sheet
/// (faces connected by other edges) is taken or left as a whole. Of all maximal choices, the one with the
/// least length of free edges wins. Among equal ones it is the one that encloses the least volume, because
/// its faces are nearest to the void. If an end is missing, free edges must remain for it. All faces are
/// taken if there are too many choices to enumerate, if a sheet meets itself at such an edge, or if no choice
/// is valid.
/// @throw InvalidInput "topology.walls_ambiguous"  two choices are equally good; names both.
/// @throw Cancelled
/// @note  O(faces) if no edge is used more than twice; otherwise exponential in the number of sheets, up to a
///         bound.
WallChoice find_walls(const Model& model, const std::vector<FaceId>& source,
                      const std::vector<FaceId>& target, const RunContext& context = {});

} // namespace lacuna::topology
