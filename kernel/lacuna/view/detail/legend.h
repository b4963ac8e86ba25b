// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/view/detail/palette.h>

#include <string>
#include <vector>

namespace lacuna::view {

/// What a colour means.
struct Key {
    Colour colour{};
    std::string text;
    bool hatched = false;
    bool line = false; ///< of an edge, not of a face
};

/// What a picture says in words.
struct Legend {
    std::string title;            ///< above what is shown; empty: none
    std::span<const Colour> ramp; ///< a bar of colours with the numbers at its ends; empty: none
    double low = 0, high = 1;
    std::string quantity; ///< what the bar's numbers are
    std::vector<Key> keys;
};

/// A rectangle of one colour, or a stroke.
struct Mark {
    Vec2 from, to; ///< opposite corners, or ends; y down [pixels]
    Colour colour{};
    double width = 0;     ///< of a stroke [pixels]; 0: a rectangle
    bool hatched = false; ///< of a rectangle
};

/// Where the words stand and what they leave free.
struct PlacedLegend {
    std::vector<Mark> marks;
    double above = 0, below = 0; ///< rows that they take [pixels]
};

/// Place a legend round a picture: the title above, the bar and the keys in rows below. Keys beyond three
/// rows are counted, not shown.
PlacedLegend place_legend(const Legend& legend, int width, int height);

} // namespace lacuna::view
