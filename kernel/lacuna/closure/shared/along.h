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

/// Class 0: a source alone, swept along a path. It is not one of the paper's.
namespace lacuna::closure {

/// A source and its motion.
struct SweptSource {
    topology::OpenVolume source; ///< faces of the source alone
    geometry::MotionPointer motion;
    bool full_turn = false; ///< the motion ends where it starts
    /// By edge of the source's rim: the sets that contain it. The walls that the edge sweeps get these sets.
    std::map<EdgeId, std::vector<std::string>> sets{};
    /// Set if edges of the source lie on the axis of its turn. Such a volume is swept with wedges
    /// (`sweep/shared/turn_at_axis.h`), and not sealed.
    std::optional<Along::Axis> on_axis{};
    /// Given walls alone, which replace the walls that the motion makes in their places; none: empty.
    std::optional<topology::Model> walls{};
};

/// Give a source the motion along a path.
/// @param model  contains the edges of a path.
/// @throw InvalidInput "closure.along_…"  the path has no length or an unknown edge; the source touches the
///         axis at a point, has several parts or is closed; the section shrinks to nothing; the ray from a
///         point of the source meets the target face not at all or twice. Or the errors of
///         `geometry::motion_along_path()`.
/// @throw Cancelled
SweptSource swept_source(const topology::Model& model, topology::OpenVolume source, const Along& along,
                         const RunContext& context);

/// @throw InvalidInput "closure.along_axis"  edges of the source lie on the axis of its turn.
void refuse_edges_on_axis(const SweptSource& swept);

/// Build the skin of a source swept along a path. Each rim edge of the source sweeps one void wall for each
/// section of the path between two of its corners. Each rim vertex sweeps a void edge along the path. Each
/// face of the source has an image on the target. New entities have the exact geometry of the motion. After a
/// full turn there are walls only.
/// @throw InvalidInput  an option shapes missing faces, which the motion defines here; or the errors of
///         `refuse_edges_on_axis()`.
/// @throw NotClosed "closure.along_folds"  the path bends within the width of the source, or layers along the
///         normals would fold. "closure.along_crosses"  the volume would cross itself. Both name the place.
Closed close_along(const SweptSource& swept, const CloseOptions& options, const RunContext& context);

/// Set the void edges and faces of a closure, and whether the volume is watertight, from the volume.
void list_void(Closed& closed);

/// The two halves of a full turn, sealed. They share both ends.
std::vector<StepPiece> halves_along(const SweptSource& swept, const RunContext& context);

} // namespace lacuna::closure
