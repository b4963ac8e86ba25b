// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/view/detail/palette.h>

#include <string>
#include <vector>

namespace lacuna::view {

/// An entry of the legend: the meaning of a colour.
struct Key {
    Colour colour{};
    std::string text;
    bool hatched = false;
    bool line = false; ///< the colour of an edge, not of a face
};

/// The text of a picture.
struct Legend {
    std::string title;            ///< above the picture; empty: none
    std::span<const Colour> ramp; ///< colour bar with numbers at its ends; empty: none
    double low = 0, high = 1;
    std::string quantity; ///< name of the quantity on the colour bar
    std::vector<Key> keys;
};

/// A filled rectangle or a stroke.
struct Mark {
    Vec2 from, to; ///< opposite corners, or end points; y points down [pixels]
    Colour colour{};
    double width = 0;     ///< stroke width [pixels]; 0: a rectangle
    bool hatched = false; ///< for rectangles
};

/// The positions of the texts, and the space they take.
struct PlacedLegend {
    std::vector<Mark> marks;
    double above = 0, below = 0; ///< height taken above and below the picture [pixels]
};

/// Lay out a legend: the title above the picture, the colour bar and the keys in rows below it. Keys beyond
/// three rows are only counted.
PlacedLegend place_legend(const Legend& legend, int width, int height);

} // namespace lacuna::view
