// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/sweep.h>

#include <optional>
#include <span>
#include <vector>

/// Volume that straight sides on bends lose, in closed form, before meshing. Internal to this folder.
///
/// A side h on a curvature k has the sag k h²/8, and the area between it and the curve is k h³/12. So a rim
/// loses the integral of k h²/12 of its end's area, and an end the integral of (k₁ h₁² + k₂ h₂²)/12 over it
/// of the volume. Facets count as the surface they approximate: the integral of k is the sum of their bends,
/// independent of the nodes. Concave bends gain as much, with the opposite sign.
namespace lacuna::sweep {

/// Allowed shares of lost or gained volume with default numbers: in total, and of that by the bends of the
/// ends and of the sweep. The total must stay within 1 %; the margin covers errors of the closed forms: quads
/// inside ends are up to a fifth longer than the size.
inline constexpr double kAllLost = 0.008, kLostByEnds = 0.002, kLostByLayers = 0.003;

/// Whether size, layers and curvature are all defaults: then the volume determines them.
bool sizes_by_default(const SweepOptions& options);

/// Whether sides between given nodes of rims may be split: all numbers are defaults, no face has given quads,
/// and no neighbour has nodes there.
bool may_divide_rims(const topology::OpenVolume& volume, const SweepOptions& options);

/// A constant size field.
surface::SizeField even_size(double length);

/// Relative loss of the sealed volume in a mesh.
double volume_lost(const Fidelity& fidelity);

/// Sides for a full turn that lose six tenths of the allowed share: the rest is reserved for the layers'
/// bends. A polygon of n sides in a circle lacks about 2 π² / 3 n² of its area.
int sides_for_volume(double share, int before);

/// Sides for a full turn for another sweep if a mesh with given numbers loses more than the options allow;
/// nothing if it does not, or more sides would not help.
std::optional<int> sides_for_lost_volume(const Fidelity& fidelity, const SweepOptions& options);

/// Whether a mesh with more sides should replace the previous one: its loss is clearly smaller.
/// @param after, before  relative loss of the sealed volume
bool is_closer(double after, double before);

/// Sides for a full turn that keep the loss of rims within bounds: the requested number, or more. If numbers
/// are given, rims that lose more than `SweepOptions::volume_share` get `sides_for_volume()`.
int planned_sides(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                  const SweepOptions& options, const surface::SizeField& size);

/// Factor on the default size that keeps the loss of the ends within bounds, in (0, 1].
/// @param size  of the source's quads
double planned_part_of_size(const topology::OpenVolume& volume, KnownLinks& links,
                            const SweepOptions& options, const surface::SizeField& size,
                            const RunContext& context);

/// Number of layers that keeps the loss of the sweep's bends within bounds, at least `least`.
int planned_layers(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                   int least, const SweepOptions& options, const RunContext& context);

} // namespace lacuna::sweep
