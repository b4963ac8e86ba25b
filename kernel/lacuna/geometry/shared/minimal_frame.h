// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

#include <span>
#include <vector>

/// Rotation-minimising frames @cite wang_2008_frames: a frame is moved from each section to the next by the
/// smallest rotation that maps one direction of the path onto the other.
namespace lacuna::geometry {

/// Direction of the curve through the centres of sections, at each centre. The direction is averaged over a
/// length equal to the width of the section, because the centres of sections through coarse facets scatter.
/// @param middles  centre of each section.
/// @param widths   width of each section.
/// @return  unit vectors; zero if centres coincide.
std::vector<Vec3> ways_along(std::span<const Vec3> middles, std::span<const double> widths);

/// The smallest rotation from one direction to another; identity if one of them is zero.
Eigen::Matrix3d least_turn(const Vec3& from, const Vec3& to);

} // namespace lacuna::geometry
