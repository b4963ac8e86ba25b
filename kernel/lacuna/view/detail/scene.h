// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/view/detail/legend.h>
#include <lacuna/view/picture.h>

#include <vector>

namespace lacuna::view {

/// A quad or a triangle to be drawn.
struct DrawnSide {
    std::array<Vec3, 4> corner;
    std::size_t count = 4; ///< of corners
    unsigned hidden = 0;   ///< bit k: no line from corner k to the next
    Colour colour{};
    bool hatched = false;
    bool closed = true; ///< part of a skin that faces outward: not drawn from behind
};

/// A line over the sides.
struct DrawnLine {
    Vec3 from, to;
    Colour colour{};
    double width = 1; ///< [pixels]
};

struct Scene {
    std::vector<DrawnSide> sides;
    std::vector<DrawnLine> lines;
    Legend legend;
};

/// @throw InvalidInput  as `write_picture()`.
Scene scene_of(std::span<const Region> regions, const PictureOptions& options, const RunContext& context);
/// @param roles  of each face, or null.
Scene scene_of(const topology::Model& model, const std::vector<topology::Role>* roles,
               const PictureOptions& options);

/// The least number on the bar of quality: 0.5, or lower where there is something lower.
double quality_low(double least);

} // namespace lacuna::view
