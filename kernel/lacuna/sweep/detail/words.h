// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/sweep/sweep.h>

#include <string>

/// Positions and suggestions in messages. Internal to this folder.
namespace lacuna::sweep {

/// A position as text, in numbers of two significant digits: "(1.2, 0, 3)".
std::string place_in_short(const Vec3& p);

/// Add to a swept volume's notes and report that its cells are poor.
void note_poor_cells(Swept& swept);

/// Add to a swept volume's notes and report that its volume is not that of the sealed shape.
void note_lost_volume(Swept& swept, const topology::OpenVolume& volume, const SweepOptions& options);

/// Sizes are suggested a tenth smaller than an estimate requires, because side lengths vary.
inline constexpr double kSuggestedShare = 0.9;

} // namespace lacuna::sweep
