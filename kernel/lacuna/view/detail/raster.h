// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/view/detail/scene.h>

#include <cstdint>
#include <vector>

namespace lacuna::view {

struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; ///< rows from top to bottom
};

/// Draw a scene as `write_picture()` describes.
Image rasterise(const Scene& scene, const PictureOptions& options, const RunContext& context);

} // namespace lacuna::view
