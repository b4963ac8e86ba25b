// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/sweep.h>

/// Volume that straight sides on bends miss, and the sides by which they miss less. Internal to this folder.
namespace lacuna::sweep {

/// A turn needs no more sides than this for its volume: an inscribed polygon of so many is off by 0.07 %.
inline constexpr int kMostPerTurn = 100;
/// More sides help where they leave less than this of the volume's error. A choice, not a measurement.
inline constexpr double kLessLost = 0.75;

/// Share of the sealed volume that is missing in the mesh.
double volume_lost(const Fidelity& fidelity);

/// Whether that is more than the options allow, and more sides may help.
bool loses_volume(const Fidelity& fidelity, const SweepOptions& options);

/// Sides for a full turn that lose six tenths of the share allowed: the rest is for the layers' bends. A
/// polygon of n sides in a circle lacks about 2 π² / 3 n² of its area.
int sides_for_volume(double share, int before);

} // namespace lacuna::sweep
