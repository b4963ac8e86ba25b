// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::sweep {

/// Least number of layers of a full turn: with fewer layers, one layer spans 120° or more, too much for a
/// cell.
inline constexpr int kLeastPerTurn = 4;

/// A turn around an axis that contains edges of the source.
struct AxisTurn {
    Vec3 point, axis; ///< a point on the axis, and its direction, of length 1
    double angle = 0; ///< [radian], up to a full turn
    bool is_full = false;
};

/// Revolve the quads of a source around an axis that contains sides of some of them. Quads with a side on the
/// axis become wedges, the others hexahedra.
///
/// Along each segment of the axis, the wedges are a mesh of triangles around the axis, swept along it. The
/// hexahedra are swept around the axis, in two halves for a full turn. All parts therefore have the structure
/// of other swept meshes. Nodes lie exactly on their circles.
/// @param flat  the source, sealed with a moved copy of it as the target
/// @param base  the mesh of `flat`, with one layer
/// @throw NotSweepable "sweep.axis_corner"  a quad touches the axis with one corner only; or as
///         `quality::prove()`. NotClosed "closure.along_folds"  the source does not advance everywhere.
///         InvalidInput "sweep.axis_layers"  the layers have given heights, or are too few. Cancelled
SweptAssembly turn_at_axis(const AxisTurn& turn, const topology::OpenVolume& flat, const Swept& base,
                           const SweepOptions& options, const RunContext& context);

} // namespace lacuna::sweep
