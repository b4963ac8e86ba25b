// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <span>

/// Volume that straight sides on bends miss, worked out before anything is meshed. Internal to this folder.
///
/// Of the walls by a model of the mesh's skin there: what the quads between its nodes enclose, of order 2
/// with the parabolas through their middles. Of the ends in closed form: a side h on a curvature k has the
/// sag k h²/8, and an end loses the integral of (k₁ h₁² + k₂ h₂²)/12 over it. Facets count as the surface
/// they stand for. What bends inwards gains as much and counts against it.
namespace lacuna::sweep {

/// Whether nobody asked for a size, layers or sides for a turn: then the volume decides.
bool sizes_by_default(const SweepOptions& options);

/// Whether sides between the nodes that rims came with may be divided: nothing was asked for, no face came
/// with quads, and no neighbour has nodes there.
bool may_divide_rims(const topology::OpenVolume& volume, const SweepOptions& options);

/// One size everywhere.
surface::SizeField even_size(double length);

/// Share of the sealed volume that is missing in a mesh.
double volume_lost(const Fidelity& fidelity);

/// Numbers by which a mesh keeps the volume.
struct VolumePlan {
    int per_turn = 12;                      ///< sides for a full turn: as many as are asked for, or more
    double part = 1;                        ///< of the default size, for the bends of the ends, in (0, 1]
    std::function<int(int least)> layers{}; ///< for the bends of the walls; null: as many as there are
};

/// Where nobody asked for numbers the volume is to be within 1 %; where somebody did, rims and layers that
/// lose more than `SweepOptions::volume_share` get more.
/// @param size  of the source's quads. @throw Cancelled
VolumePlan plan_volume(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                       const SweepOptions& options, const surface::SizeField& size,
                       const RunContext& context);

} // namespace lacuna::sweep
