// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/sweep.h>

#include <optional>

/// Volume that straight sides on bends miss, and the sides by which they miss less. Internal to this folder.
namespace lacuna::sweep {

/// A turn needs no more sides than this for its volume: an inscribed polygon of so many is off by 0.07 %.
inline constexpr int kMostPerTurn = 100;

/// Share of the sealed volume that is missing in the mesh.
double volume_lost(const Fidelity& fidelity);

/// Whether that is more than the options allow, and more sides may help.
bool loses_volume(const Fidelity& fidelity, const SweepOptions& options);

/// Sides for a full turn that lose six tenths of the share allowed: the rest is for the layers' bends. A
/// polygon of n sides in a circle lacks about 2 π² / 3 n² of its area.
int sides_for_volume(double share, int before);

/// Sides for a full turn to sweep with anew where a mesh loses more than the options allow; nothing where it
/// does not, or has as many as help.
std::optional<int> sides_for_lost_volume(const Fidelity& fidelity, const SweepOptions& options);

/// Whether a mesh made with more sides is to take the place of the one before it: it lacks clearly less.
/// @param after, before  shares of the sealed volume that are missing
bool is_closer(double after, double before);

} // namespace lacuna::sweep
