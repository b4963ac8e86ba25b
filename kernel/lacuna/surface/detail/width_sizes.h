// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/graded_points.h>
#include <lacuna/surface/shared/shape_size.h>

#include <vector>

namespace lacuna::surface {

/// Maximum sag of a side, as a share of the distance to the opposite rim or skin [-]. If both opposite sides
/// have this sag, half of the distance remains between them.
inline constexpr double kSagOfWidth = 0.25;
/// Two places face each other if the cosine of the angle between the line that joins them, or the opposite
/// normal, and the normal is at least this (37°). The two sides of a right angle then never face each other.
inline constexpr double kFacing = 0.8;
/// Maximum distance of neighbouring points at which sizes are requested, as a multiple of the size there.
/// Halfway between two points the size is then at most a third too large. Heuristic.
inline constexpr double kApart = 2;

/// Add the sizes that the narrow places of a face request, as `shape_size()` describes.
/// @param least  minimum size that narrow places may request, as a share of the requested size [-].
void add_width_sizes(const topology::Model& model, FaceId face, const SizeField& asked,
                     const ShapeSizing& sizing, double least, std::vector<PointSize>& sizes);

} // namespace lacuna::surface
