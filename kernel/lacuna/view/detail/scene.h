// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/view/detail/cell_set.h>
#include <lacuna/view/detail/legend.h>
#include <lacuna/view/picture.h>

#include <vector>

namespace lacuna::view {

/// A quad or triangle to draw.
struct DrawnSide {
    std::array<Vec3, 4> corner;
    std::size_t count = 4; ///< number of corners
    unsigned hidden = 0;   ///< bit k: do not draw the line from corner k to the next
    Colour colour{};
    bool hatched = false;
    bool closed = true; ///< part of a closed skin, facing outward: culled when seen from behind
};

/// A line drawn over the sides.
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
/// The solids of a deck; middle nodes are not drawn.
Scene scene_of(const DeckCells& cells, const PictureOptions& options, const RunContext& context);
/// @param roles  of each face; may be null.
Scene scene_of(const topology::Model& model, const std::vector<topology::Role>* roles,
               const PictureOptions& options);

/// Lower end of the colour bar of quality: 0.5, or less if some quality is lower.
double quality_low(double least);

} // namespace lacuna::view
