// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A volume that its free loops tell how to seal: the given faces in their order, then those made, all of
/// them walls.
struct FlatFilling {
    topology::OpenVolume volume;
    Closure closure;
    bool each_alone = true; ///< whether each loop is flat and has a face of its own
    bool channel = false;   ///< whether a loop was parted where two ends are alike
};

/// Fill the free loops of some faces with flat faces. Loops in one plane that lie within each other bound one
/// face with holes. A loop that lies in two planes, as where an end and a wall beside it are missing, is
/// filled with two faces that meet in a straight void edge; that of a groove without its ends and its mouth
/// with a face for each; that of a channel without its ends and a wall with flat ends and a wall that may
/// bend.
/// @return  nothing where a loop lies in other planes, or where the result is not sealed or crosses itself.
/// @throw InvalidInput  faces that cannot be oriented. Cancelled.
std::optional<FlatFilling> fill_flat_loops(const topology::Model& model, const std::vector<FaceId>& faces,
                                           const RunContext& context);

/// Fill the free loops of a volume without a target as `fill_flat_loops()` does. Of the faces made those that
/// face away from the source, or slope by 60° at most, are the target, others are walls: risers, where the
/// target lies at several heights.
/// @param volume  out: sealed.
/// @return  nothing where each loop is flat by itself, where one lies on a ball, a round cylinder or a cone,
///          where what fills them is no flat face, and where the target has neither the source's loops nor
///          several heights.
std::optional<Closure> fill_missing_end(topology::OpenVolume& volume, const RunContext& context);

/// Whether a loop is flat.
bool is_flat(const topology::Model& model, const topology::Rim& rim);

/// Whether each of a face's loops is.
bool has_flat_loops(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
