// SPDX-License-Identifier: MIT
#pragma once

/// Symmetries of quads over a symmetric region. Only sources of this folder include it.

#include <lacuna/quads/detail/outline_symmetry.h>

#include <span>
#include <vector>

namespace lacuna::quads {

/// The symmetries of a region that also map quads onto quads, but the identity: each with the images of all
/// nodes, also of those inside.
/// @pre  `find_fault()` finds none.
std::vector<Symmetry> mesh_symmetries(const PlanarQuads& mesh, const PlanarRegion& region);

/// `symmetrise()` by symmetries that are known: those of `mesh_symmetries()`.
/// @param fixed  the first so many nodes stay.
std::size_t symmetrise(PlanarQuads& mesh, std::size_t fixed, std::span<const Symmetry> symmetries);

} // namespace lacuna::quads
