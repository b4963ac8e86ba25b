// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/graded_points.h>
#include <lacuna/surface/shared/shape_size.h>

#include <vector>

namespace lacuna::surface {

/// Add the sizes that the narrow places of a face request, as `shape_size()` describes.
/// @param least  minimum size that narrow places may request, as a share of the requested size [-].
void add_width_sizes(const topology::Model& model, FaceId face, const SizeField& asked,
                     const ShapeSizing& sizing, double least, std::vector<PointSize>& sizes);

} // namespace lacuna::surface
