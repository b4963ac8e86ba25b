// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/volume.h>

#include <string>

namespace lacuna::fill {

/// The faces, loops and edges of a volume with their geometry, and the pieces that it is cut into for
/// sweeping.
/// @throw Cancelled
std::string tree(const Volume& volume, const RunContext& context = {});

/// The roles, the class with its reason, the void faces and the match of a volume, as text.
std::string describe(const Volume& volume);

/// The faces of a model with their sizes, its free edges, gaps and cavities, a line each; `model:describe()`.
/// @throw Cancelled
std::string describe(const topology::Model& model, const RunContext& context = {});

/// The ends of a volume, as in "from face 1 to face 2, face 3".
std::string ends_in_words(const topology::OpenVolume& volume);

} // namespace lacuna::fill
