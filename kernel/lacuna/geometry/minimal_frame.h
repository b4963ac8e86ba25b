// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

#include <span>
#include <vector>

/// Rotation-minimising frames @cite wang_2008_frames, from section to section by the least turn.
namespace lacuna::geometry {

/// Which way the line through the sections' middles goes at each of them, over a length as great as the
/// section is wide: sections of coarse facets lean, and their middles stray a little from step to step.
/// @return  unit vectors; zero where middles coincide.
/// @pre  as many widths as middles.
std::vector<Vec3> ways_along(std::span<const Vec3> middles, std::span<const double> widths);

/// The least turn from one way to another; none where there is no way.
Eigen::Matrix3d least_turn(const Vec3& from, const Vec3& to);

} // namespace lacuna::geometry
