// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <array>
#include <span>
#include <vector>

namespace lacuna::io {

/// The middle node that elements of the deck have between two of its points, of each pair: its place in
/// `Deck::points`; -1: none. O(elements + pairs).
std::vector<Index> middles_between(const Deck& deck, std::span<const Segment> pairs);

/// The same between places, of which each may be several nodes of the deck, as points [the deck's length ×
/// scale]; not a number where there is none. @param tolerance  as of `nodes_at()`
std::vector<Vec3> middles_between(const Deck& deck, std::span<const Vec3> from, std::span<const Vec3> to,
                                  double tolerance, double scale = 1);

/// The node that elements of the deck have in the middle of each quad, whichever way its corners are listed;
/// -1: none. O(elements + quads).
std::vector<Index> centres_of(const Deck& deck, std::span<const Quad> quads);

/// The same by the places of the corners.
std::vector<Vec3> centres_of(const Deck& deck, std::span<const std::array<Vec3, 4>> quads, double tolerance,
                             double scale = 1);

} // namespace lacuna::io
