// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <span>

/// Volume lost because sides of the mesh are straight on curved geometry, computed before meshing. Internal
/// to this folder.
///
/// For walls, a model of the mesh's skin gives the volume enclosed by its quads; at order 2 the sides are
/// parabolas through the mid-side nodes. For ends there is a closed form: a side h on a curvature k has the
/// sag k h²/8, and an end loses the integral of (k₁ h₁² + k₂ h₂²)/12 over its area. Facets count as the
/// surface that they approximate. Concave curvature adds volume by the same formula.
namespace lacuna::sweep {

/// Whether size, layers and curvature are all defaults: then the required volume determines them.
bool sizes_by_default(const SweepOptions& options);

/// Whether sides between given rim nodes may be split: all numbers are defaults, no face has given quads, and
/// no neighbour has nodes on the rims.
bool may_divide_rims(const topology::OpenVolume& volume, const SweepOptions& options);

/// The relative volume that a mesh loses against the sealed volume.
double volume_lost(const Fidelity& fidelity);

/// Numbers of sides and layers that keep the volume error within its bound.
struct VolumePlan {
    int per_turn = 12;                      ///< sides for a full turn: the requested number, or more
    double part = 1;                        ///< factor on the default size for curved ends, in (0, 1]
    std::function<int(int least)> layers{}; ///< for curved walls; null: unchanged
};

/// Choose the numbers of sides and layers. With default numbers the volume must be within 1 %. With given
/// numbers, rims and layers are refined if they lose more than `SweepOptions::volume_share`.
/// @param size  size field of the quads of the source. @throw Cancelled
VolumePlan plan_volume(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                       const SweepOptions& options, const surface::SizeField& size,
                       const RunContext& context);

} // namespace lacuna::sweep
