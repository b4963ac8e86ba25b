// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/geometry/shared/motion.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

/// Class 0: a source alone, swept along a path. The paper does not define this class.
namespace lacuna::closure {

/// A source and its motion.
struct SweptSource {
    topology::OpenVolume source; ///< faces of the source alone
    geometry::MotionPointer motion;
    bool full_turn = false; ///< the motion ends where it starts
    /// For each rim edge of the source: the names of the sets that contain the edge. Walls that the edge
    /// sweeps become members of these sets.
    std::map<EdgeId, std::vector<std::string>> sets{};
    /// The axis of rotation, if edges of the source lie on it. Such a volume is not sealed; it is meshed with
    /// wedges at the axis (`sweep/shared/turn_at_axis.h`).
    std::optional<Along::Axis> on_axis{};
    /// A model of the given walls only. Each wall replaces one that the motion would make. Empty if no walls
    /// are given.
    std::optional<topology::Model> walls{};
};

/// Determine the motion of a source along a path.
/// @param model  the model that contains the edges of `Along::Path`.
/// @throw InvalidInput "closure.along_…"  the path has no length or an unknown edge; the source touches the
///         axis at a single point, has several parts or is closed; the section shrinks to nothing; a ray from
///         a point of the source misses the target face or meets it more than once. Also throws the errors of
///         `geometry::motion_along_path()`.
/// @throw Cancelled
SweptSource swept_source(const topology::Model& model, topology::OpenVolume source, const Along& along,
                         const RunContext& context);

/// @throw InvalidInput "closure.along_axis"  edges of the source lie on the axis of rotation.
void refuse_edges_on_axis(const SweptSource& swept);

/// Build the skin of a source swept along a path. The corners of the path divide it into sections. Each rim
/// edge of the source sweeps one void wall per section. Each rim vertex of the source sweeps a void edge
/// along the path. Each face of the source has an image on the target. New entities have the exact geometry
/// of the motion. A full turn has walls only.
/// @throw InvalidInput  an option asks for a shape of missing faces, although the motion defines it; or the
///         errors of `refuse_edges_on_axis()`.
/// @throw NotClosed "closure.along_folds"  the path bends within the width of the source, or layers along the
///         normals would fold. "closure.along_crosses"  the volume would cross itself. Both name the place.
Closed close_along(const SweptSource& swept, const CloseOptions& options, const RunContext& context);

/// Set `void_edges`, `void_faces` and `watertight` of a closure from its volume.
void list_void(Closed& closed);

/// The two halves of a full turn, each sealed. Both halves have the same two faces as ends.
std::vector<StepPiece> halves_along(const SweptSource& swept, const RunContext& context);

} // namespace lacuna::closure
