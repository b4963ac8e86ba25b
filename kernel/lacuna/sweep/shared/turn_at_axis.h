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

/// Turn the quads of a source round an axis that some of them have a side on. These become wedges, the others
/// hexahedra.
///
/// The wedges at one segment of the axis are triangles round it, swept along it; the hexahedra beside are
/// those of a sweep, in two halves for a full turn. So the parts are meshes like all others. Nodes lie
/// exactly on their circles.
/// @param flat  the source, sealed with a target that it was moved to
/// @param base  the mesh of that, of one layer
/// @throw NotSweepable "sweep.axis_corner"  a quad touches the axis with a corner alone. As
///        `quality::prove()`. NotClosed "closure.along_folds"  the source does not advance everywhere.
///        InvalidInput "sweep.axis_layers"  layers of given heights, or too few of them. Cancelled
SweptAssembly turn_at_axis(const AxisTurn& turn, const topology::OpenVolume& flat, const Swept& base,
                           const SweepOptions& options, const RunContext& context);

} // namespace lacuna::sweep
