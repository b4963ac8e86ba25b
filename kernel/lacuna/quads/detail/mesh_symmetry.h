// SPDX-License-Identifier: MIT
#pragma once

/// Symmetries of quads over a symmetric region. Only sources of this folder include it.

#include <lacuna/quads/detail/outline_symmetry.h>

#include <span>
#include <vector>

namespace lacuna::quads {

/// The symmetries of a region, except the identity, that also map the quads of a mesh onto each other. Each
/// symmetry lists the images of all nodes, including inner nodes.
/// @pre  `find_fault()` finds no fault.
std::vector<Symmetry> mesh_symmetries(const PlanarQuads& mesh, const PlanarRegion& region);

/// `symmetrise()` with known symmetries, those of `mesh_symmetries()`.
/// @param fixed  number of nodes that are not moved; they come first.
std::size_t symmetrise(PlanarQuads& mesh, std::size_t fixed, std::span<const Symmetry> symmetries);

} // namespace lacuna::quads
