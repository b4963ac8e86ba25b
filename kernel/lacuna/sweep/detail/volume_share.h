// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <span>

/// Volume that a mesh loses because its sides are straight on curved geometry, computed before meshing.
/// Internal to this folder.
///
/// For walls, a model of the mesh's skin gives the volume enclosed by its quads. At order 2 its sides are
/// parabolas through the mid-side nodes. For ends there is a closed form: a side of length h along a
/// curvature k has the sag k h²/8, and an end loses the integral of (k₁ h₁² + k₂ h₂²)/12 over its area. Here
/// k₁ and k₂ are the principal curvatures, and h₁ and h₂ the lengths of sides in their directions. Facets
/// stand for the smooth surface that they approximate. Where the surface is concave, the same formula gives
/// volume that is added.
namespace lacuna::sweep {

/// Whether size, layers and curvature all have default values. The numbers of sides then follow from the
/// required volume.
bool sizes_by_default(const SweepOptions& options);

/// Whether sides between given rim nodes may be split: all numbers of sides are defaults, no face has given
/// quads, and no neighbour has nodes on the rims.
bool may_divide_rims(const topology::OpenVolume& volume, const SweepOptions& options);

/// The relative difference between the volume of a mesh and the sealed volume.
double volume_lost(const Fidelity& fidelity);

/// Numbers of sides and layers that keep the volume error within its bound.
struct VolumePlan {
    int per_turn = 12; ///< sides for a full turn, at least the requested number
    double part = 1;   ///< factor on the default size, in (0, 1]; less than 1 for curved ends
    std::function<int(int least)> layers{}; ///< for curved walls; null: unchanged
};

/// Choose the numbers of sides and layers. With default numbers the volume must be within 1 %. If given
/// numbers lose more than `SweepOptions::volume_share`, rims and layers are refined.
/// @param size  size field of the source's quads. @throw Cancelled
VolumePlan plan_volume(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                       const SweepOptions& options, const surface::SizeField& size,
                       const RunContext& context);

} // namespace lacuna::sweep
