// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/io/load_facets.h>

/// Faces from finite element meshes. Internal to this folder.
namespace lacuna::io {

/// The facets of a deck: its shells, and the sides of solids that are free or between two regions, each once.
///
/// Shells are divided into labels by region and by the element sets and surfaces that contain them, sides of
/// solids by the one or two regions that they bound and by surfaces. A shell on sides of solids replaces
/// them. Sets of a single shell are ignored, and if more than 20 labels would have only one shell, these
/// shells share a label. Nodes within the tolerance of each other count as one, so that touching parts share
/// sides.
/// @param tolerance  [the deck's length]; 0: 1e-6 × the diagonal.
/// @throw InvalidInput "io.no_faces"
/// @note  O(n) in the elements; O(n log n) if tags have large gaps.
FacetFile facets_of(const Deck& deck, double tolerance = 0);

} // namespace lacuna::io
