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
};

/// Give a source the motion along a path.
/// @param model  contains the edges of a path.
/// @throw InvalidInput "closure.along_…"  a path without length or with an unknown edge; a source that
///                     touches the axis at a point, has several parts or is closed; a section that shrinks to
///                     nothing; a place of the source whose ray meets the face nowhere or twice. As
///                     `geometry::motion_along_path()`. Cancelled.
SweptSource swept_source(const topology::Model& model, topology::OpenVolume source, const Along& along,
                         const RunContext& context);

/// @throw InvalidInput "closure.along_axis"  edges of the source lie on the axis of its turn.
void refuse_edges_on_axis(const SweptSource& swept);

/// Seal a source and its motion: each edge of its rim becomes void walls, one between two corners of the
/// path, each vertex of its rim a void edge along the path, and each of its faces a face of the target. All
/// have the exact geometry that the motion gives them. After a full turn there are walls only.
/// @throw InvalidInput  options that shape missing faces. As `refuse_edges_on_axis()`.
/// @throw NotClosed "closure.along_folds"  the path bends more than the source allows, or its layers would
///        fold; "closure.along_crosses": the volume would cross itself. Both say where.
Closed close_along(const SweptSource& swept, const CloseOptions& options, const RunContext& context);

/// The two halves of a full turn, sealed, which share both ends.
std::vector<StepPiece> halves_along(const SweptSource& swept, const RunContext& context);

} // namespace lacuna::closure
