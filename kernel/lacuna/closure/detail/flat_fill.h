// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A volume that was sealed without ends, by filling its free loops: the given faces in their order, then the
/// new ones. All have the role of walls.
struct FlatFilling : Closed {
    bool each_alone = true; ///< whether each loop is planar and has its own face
    bool channel = false;   ///< whether a loop was split at two congruent ends
};

/// Loops that bound one flat face: indices of the outer loop, then of its holes.
struct FlatRegion {
    geometry::Plane plane;
    std::vector<std::size_t> loops{};
};

/// Sort the flat ones of some loops into the flat faces that they bound.
std::vector<FlatRegion> flat_regions(const topology::Model& model, const std::vector<topology::Loop>& loops);

/// Fill the free loops of some faces with flat faces. Coplanar nested loops bound one face with holes. A loop
/// in two planes, as where an end and an adjacent wall are missing, is filled with two faces that meet in a
/// straight void edge. The loop of a groove that lacks its ends and its mouth gets one face for each end and
/// one for the mouth; the loop of a channel that lacks its ends and one wall gets flat ends and a wall that
/// may bend.
/// @return  empty if a loop is none of these, or if the result is not sealed or crosses itself.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
std::optional<FlatFilling> fill_flat_loops(const topology::Model& model, const std::vector<FaceId>& faces,
                                           const RunContext& context);

/// Fill the free loops as `fill_flat_loops()` does, and join pairs of loops by round walls, see
/// `add_tubes()`. Any other loop gets one face with the shape that its rim determines; `guess_of_bent()`
/// reports a rim that does not determine a shape.
std::optional<FlatFilling> fill_all_loops(const topology::Model& model, const std::vector<FaceId>& faces,
                                          const RunContext& context);

/// Fill the free loops of a volume without a target as `fill_flat_loops()` does. New faces that are inclined
/// to the source by at most 60° form the target; if there are none, the least inclined do. The other new
/// faces are walls, such as the risers of a target at several heights.
/// @return  empty in any of these cases:
/// - every loop is planar and gets a face of its own;
/// - a loop lies on a sphere, a circular cylinder or a cone, or belongs to a channel
///   (`FlatFilling::channel`);
/// - a loop of a new face is not flat;
/// - the result is not sealed;
/// - the target is one connected part, but does not have as many loops as the source.
std::optional<FlatFilling> fill_missing_end(const topology::OpenVolume& volume, const RunContext& context);

/// Whether a loop is flat.
bool is_flat(const topology::Model& model, const topology::Rim& rim);

/// Whether each loop of a face is flat.
bool has_flat_loops(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
