// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/volume.h>

#include <string>

namespace lacuna::fill {

/// Faces, loops and edges of a volume with their geometry, and the pieces it is cut into to be swept.
/// @throw Cancelled
std::string tree(const Volume& volume, const RunContext& context = {});

/// Roles, class and why, void faces, match.
std::string describe(const Volume& volume);

/// The ends of a volume: "from face 1 to face 2, face 3".
std::string ends_in_words(const topology::OpenVolume& volume);

} // namespace lacuna::fill
