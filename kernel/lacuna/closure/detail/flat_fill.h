// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/newell.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// A volume that was sealed by filling its free loops, without ends: all faces are walls. The given faces
/// come first, in their order, then the new ones.
struct FlatFilling : Closed {
    bool each_alone = true; ///< whether each loop is planar and has its own face
};

/// Loops that bound one flat face.
struct FlatRegion {
    geometry::Plane plane;
    std::vector<std::size_t> loops{};
};

/// The flat faces that the flat loops among `loops` bound. Loops that are not flat are ignored.
std::vector<FlatRegion> flat_regions(const topology::Model& model, const std::vector<topology::Loop>& loops);

/// Kinds of missing faces that loops are filled with.
enum class Missing {
    flat, ///< flat faces, without new vertices
    any,  ///< also round walls that join pairs of loops (see `add_tubes()`); any other loop gets one face of
          ///< the shape that the loop determines. If it determines none, `guess_of_bent()` reports the face.
};

/// Fill the free loops of some faces. Coplanar nested loops bound one flat face with holes. A loop around
/// two or three missing faces is split (`split_touching()`), such as that of a missing end and an adjacent
/// missing wall, or that of a groove that lacks its ends and its mouth.
/// @return  empty if `missing` is `flat` and a face may be bent, or if the result is not sealed or crosses
///         itself.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
std::optional<FlatFilling> fill_free_loops(const topology::Model& model, const std::vector<FaceId>& faces,
                                           Missing missing, const RunContext& context);

/// Fill the free loops of a volume without a target with flat faces, as `fill_free_loops()` does. New faces
/// that are inclined to the source by at most 60° form the target. If there are none, the least inclined new
/// faces form the target. The other new faces are walls, such as the risers of a target at several heights.
/// @return  empty in any of these cases:
/// - every loop is planar and gets a face of its own;
/// - a loop lies on a sphere, a circular cylinder or a cone;
/// - a new face would be bent;
/// - the result is not sealed;
/// - the target is one connected part, but does not have as many loops as the source.
std::optional<FlatFilling> fill_missing_end(const topology::OpenVolume& volume, const RunContext& context);

/// Whether a loop is flat.
bool is_flat(const topology::Model& model, const topology::Rim& rim);

/// Whether each loop of a face is flat.
bool has_flat_loops(const topology::Model& model, FaceId face);

} // namespace lacuna::closure
