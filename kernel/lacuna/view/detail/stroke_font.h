// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <string_view>
#include <utility>
#include <vector>

namespace lacuna::view {

/// A text as strokes, starting at its upper left corner; a dot is a stroke of zero length.
struct StrokedText {
    std::vector<std::pair<Vec2, Vec2>> strokes; ///< y points down [capital height]
    double width = 0;                           ///< [capital height]
};

/// Draw a line of ASCII text. Other characters become boxes, so that texts keep their length.
/// @param text  UTF-8.
StrokedText stroked(std::string_view text);

} // namespace lacuna::view
