// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/io/load_facets.h>

/// Faces from finite element meshes.
namespace lacuna::io {

/// The least tolerance by default [the deck's length]: what nobody sees, a thousandth of the shortest side of
/// an element, or as far as the rounding of coordinates in the file can move a point off the line or plane of
/// others, if that is further: two units of the last digit that the file's numbers have, or of single
/// precision if all of them are such numbers; at most a hundredth of the shortest side. Numbers with fewer
/// than five or more than nine significant digits count as exact. 0: there are no sides.
double least_tolerance(const Deck& deck);

/// The facets of a deck, each once: its shells, and the sides of solids that are free or lie between two
/// regions.
///
/// Shells are divided into labels by their region and by the element sets and surfaces that contain them.
/// Sides of solids are divided by the one or two regions that they bound and by the surfaces that contain
/// them. A shell replaces the sides of solids on which it lies. Sets of a single shell are ignored. If more
/// than 20 labels would have only one shell, these shells share a label. Nodes within the tolerance of each
/// other count as one, so that touching parts share sides.
/// @param tolerance  [the deck's length]; 0: 1e-6 × the diagonal, or `least_tolerance()` if that is larger.
/// @throw InvalidInput "io.no_faces"
/// @note  O(n) in the elements; O(n log n) if tags have large gaps.
FacetFile facets_of(const Deck& deck, double tolerance = 0);

} // namespace lacuna::io
