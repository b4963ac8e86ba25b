// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/linking_surface.h>
#include <lacuna/surface/size_field.h>
#include <lacuna/sweep/detail/known_links.h>
#include <lacuna/sweep/sweep.h>

#include <optional>
#include <span>
#include <vector>

/// Volume that straight sides on bends miss, in closed form, before anything is meshed. Internal to this
/// folder.
///
/// A side h on a curvature k has the sag k h²/8, and between it and the curve lies the area k h³/12. So a rim
/// loses the integral of k h²/12 of its end's area, and an end the integral of (k₁ h₁² + k₂ h₂²)/12 over it
/// of the volume. Facets count as the surface they stand for: the integral of k is the sum of their bends,
/// whatever lies between their vertices and the nodes. What bends inwards gains as much and counts against
/// it.
namespace lacuna::sweep {

/// Shares of the volume that may be missing, or be too much, where nobody asked for numbers: in all, and of
/// that by the bends of the ends and by those of the sweep, where there are any. All is to stay within 1 %;
/// the rest is for what closed forms leave out: quads inside ends are up to a fifth longer than the size.
inline constexpr double kAllLost = 0.008, kLostByEnds = 0.002, kLostByLayers = 0.003;

/// Whether nobody asked for a size, layers or sides for a turn: then the volume decides.
bool sizes_by_default(const SweepOptions& options);

/// Whether sides between the nodes that rims came with may be divided: nothing was asked for, no face came
/// with quads, and no neighbour has nodes there.
bool may_divide_rims(const topology::OpenVolume& volume, const SweepOptions& options);

/// One size everywhere.
surface::SizeField even_size(double length);

/// Share of the sealed volume that is missing in a mesh.
double volume_lost(const Fidelity& fidelity);

/// Sides for a full turn that lose six tenths of the share allowed: the rest is for the layers' bends. A
/// polygon of n sides in a circle lacks about 2 π² / 3 n² of its area.
int sides_for_volume(double share, int before);

/// Sides for a full turn to sweep with anew where a mesh with given numbers loses more than the options
/// allow; nothing where it does not, or has as many as help.
std::optional<int> sides_for_lost_volume(const Fidelity& fidelity, const SweepOptions& options);

/// Whether a mesh made with more sides is to take the place of the one before it: it lacks clearly less.
/// @param after, before  shares of the sealed volume that are missing
bool is_closer(double after, double before);

/// Sides for a full turn by which rims lose no more than they may: as many as are asked for, or more.
/// Where numbers are given, rims that lose more than `SweepOptions::volume_share` get `sides_for_volume()`.
int planned_sides(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                  const SweepOptions& options, const surface::SizeField& size);

/// Part of the default size by which the ends lose no more than they may, in (0, 1].
/// @param size  of the source's quads
double planned_part_of_size(const topology::OpenVolume& volume, KnownLinks& links,
                            const SweepOptions& options, const surface::SizeField& size,
                            const RunContext& context);

/// Layers by which the bends of the sweep lose no more than they may, `least` at least.
int planned_layers(const topology::OpenVolume& volume, std::span<const surface::LinkingSurface> links,
                   int least, const SweepOptions& options, const RunContext& context);

} // namespace lacuna::sweep
