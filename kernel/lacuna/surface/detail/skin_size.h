// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/detail/graded_points.h>
#include <lacuna/surface/detail/skin_shape.h>

#include <span>
#include <vector>

namespace lacuna::surface {

/// Sizes of the triangles of a skin: the requested size, reduced where the skin is curved, narrow or thin,
/// and adapted to given nodes nearby.
///
/// - Curvature: a full turn has n sides. n >= 12 is the smallest number with which the skin loses at most
///   half of `kSameVolume` of its volume. The loss is estimated from the mean distance between a side and the
///   surface: k h² / 12 for a side of length h in a direction of curvature k.
/// - Width: faces and edges are treated as in `shape_size()`, down to a tenth of the requested size.
/// - Thin places: if the opposite skin is at a distance w, the sag of a side is at most a quarter of w.
/// - Short edges have one side.
///
/// @param given  midpoints and lengths of the sides of given meshes.
/// @param size   requested size.
SizeField skin_sizes(const topology::Model& model, std::span<const SkinLine> lines,
                     std::vector<PointSize> given, const SizeField& size, const RunContext& context);

} // namespace lacuna::surface
