// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

#include <array>
#include <span>
#include <vector>

namespace lacuna::io {

/// For each pair of positions: the middle node that elements of the deck have between them, as a point [the
/// deck's length × scale]; NaN if there is none. Several nodes of the deck may lie at one position.
/// O(elements + pairs).
/// @param tolerance  as in `nodes_at()`
std::vector<Vec3> middles_between(const Deck& deck, std::span<const Vec3> from, std::span<const Vec3> to,
                                  double tolerance, double scale = 1);

/// For each quad: the centre node that elements of the deck have between its corners, in any order, as a
/// point; NaN if there is none.
std::vector<Vec3> centres_of(const Deck& deck, std::span<const std::array<Vec3, 4>> quads, double tolerance,
                             double scale = 1);

} // namespace lacuna::io
