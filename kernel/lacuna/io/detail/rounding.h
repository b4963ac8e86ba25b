// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>

/// Accuracy of the coordinates of a file. Internal to this folder.
namespace lacuna::io {

/// Distance by which the rounding of coordinates in a file can move a point off the line or plane of others
/// [the deck's length]: two units of the last digit that the file's numbers have, or of single precision if
/// all of them are such numbers; at most a hundredth of the shortest side of an element. 0: the numbers have
/// fewer than five or more than nine significant digits, so they are exact or of double precision.
double rounding_of(const Deck& deck);

} // namespace lacuna::io
