// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A volume that flat faces seal: the given ones in their order, then these, all of them walls.
struct FlatFilling {
    topology::OpenVolume volume;
    Closure closure;
    bool each_alone = true; ///< whether each loop is flat and has a face of its own
};

/// Fill the free loops of some faces with flat faces. Loops in one plane that lie within each other bound one
/// face with holes. A loop that lies in two planes, as where an end and a wall beside it are missing, is
/// filled with two faces that meet in a straight void edge; that of a groove without its ends and its mouth
/// with a face for each.
/// @return  nothing where a loop lies in more planes, or where the result is not sealed or crosses itself.
/// @throw InvalidInput  faces that cannot be oriented. Cancelled.
std::optional<FlatFilling> fill_flat_loops(const topology::Model& model, const std::vector<FaceId>& faces,
                                           const RunContext& context);

/// Whether a loop is flat.
bool is_flat(const topology::Model& model, const topology::Rim& rim);

/// Whether each of a face's loops is.
bool has_flat_loops(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
