// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <span>

/// Volume that straight sides on bends lose, computed before meshing. Internal to this folder.
///
/// For the walls by a model of the mesh's skin there: the volume enclosed by its quads, at order 2 with
/// parabolas through the middle nodes. For the ends in closed form: a side h on a curvature k has the sag
/// k h²/8, and an end loses the integral of (k₁ h₁² + k₂ h₂²)/12 over it. Facets count as the surface they
/// approximate. Concave bends gain as much, with the opposite sign.
namespace lacuna::sweep {

/// Whether size, layers and curvature are all defaults: then the volume determines them.
bool sizes_by_default(const SweepOptions& options);

/// Whether sides between given nodes of rims may be split: all numbers are defaults, no face has given quads,
/// and no neighbour has nodes there.
bool may_divide_rims(const topology::OpenVolume& volume, const SweepOptions& options);

/// A constant size field.
surface::SizeField even_size(double length);

/// Relative loss of the sealed volume in a mesh.
double volume_lost(const Fidelity& fidelity);

/// Numbers by which a mesh keeps the volume.
struct VolumePlan {
    int per_turn = 12;                      ///< sides for a full turn: the requested number, or more
    double part = 1;                        ///< of the default size, for the bends of the ends, in (0, 1]
    std::function<int(int least)> layers{}; ///< for the bends of the walls; null: unchanged
};

/// With default numbers the volume must be within 1 %; with given numbers, rims and layers that lose more
/// than `SweepOptions::volume_share` get more.
/// @param size  of the source's quads. @throw Cancelled
VolumePlan plan_volume(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                       const SweepOptions& options, const surface::SizeField& size,
                       const RunContext& context);

} // namespace lacuna::sweep
