// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/io/load_facets.h>

/// Faces from finite element meshes. Internal to this folder.
namespace lacuna::io {

/// The facets of a deck: its shells, and the sides of solids that are free or between two regions, each once.
///
/// Labels part shells by region and by the element sets and surfaces they are in, sides of solids by the one
/// or two regions they bound and by surfaces. A shell that lies on sides of solids stands for them. Sets of a
/// single shell part nothing, and where more than 20 labels would be of one shell each, these shells are one
/// label. Nodes within the tolerance of each other count as one, so that parts that touch share sides.
/// @param tolerance  [the deck's length]; 0: 1e-6 × the diagonal.
/// @throw InvalidInput "io.no_faces"
/// @note  O(n) in the elements but for finding sparse tags.
FacetFile facets_of(const Deck& deck, double tolerance = 0);

} // namespace lacuna::io
