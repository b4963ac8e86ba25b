// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/assembly.h>
#include <lacuna/sweep/sweep.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::sweep {

/// A turn of a source with edges on its axis.
struct AxisTurn {
    Vec3 point, axis; ///< the axis; of length 1
    double angle = 0; ///< [radian], up to a full turn
    bool is_full = false;
};

/// Revolve the quads of a source around an axis that contains sides of some quads. These quads become wedges,
/// the others hexahedra.
///
/// The wedges at one segment of the axis are triangles around it, swept along the axis. The hexahedra are
/// those of a sweep, in two halves for a full turn. So all parts are structured like other swept meshes.
/// Nodes lie exactly on their circles.
/// @param flat  the source, sealed with a moved copy of it as the target
/// @param base  the mesh of `flat`, with one layer
/// @throw NotSweepable "sweep.axis_corner"  a quad touches the axis with one corner only. As
///     `quality::prove()`. NotClosed "closure.along_folds"  the source does not advance everywhere.
///     InvalidInput "sweep.axis_layers"  layers of given heights, or too few of them. Cancelled
SweptAssembly turn_at_axis(const AxisTurn& turn, const topology::OpenVolume& flat, const Swept& base,
                           const SweepOptions& options, const RunContext& context);

} // namespace lacuna::sweep
