// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string_view>
#include <utility>
#include <vector>

namespace lacuna::view {

/// A text as strokes, from its left upper corner on; a dot is a stroke without length.
struct StrokedText {
    std::vector<std::pair<Vec2, Vec2>> strokes; ///< y down [capital height]
    double width = 0;                           ///< [capital height]
};

/// Write a line with the letters of ASCII. Another character is a box, so that a name keeps its length.
/// @param text  UTF-8.
StrokedText stroked(std::string_view text);

} // namespace lacuna::view
