// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <Eigen/Core>

#include <span>
#include <vector>

/// Rotation-minimising frames @cite wang_2008_frames: from section to section by the smallest rotation.
namespace lacuna::geometry {

/// Direction of the curve through the section centres, at each centre. It is averaged over a length equal to
/// the width of the section, because the centres of coarse sections vary slightly from step to step.
/// @return  unit vectors; zero if centres coincide.
/// @pre  as many widths as middles.
std::vector<Vec3> ways_along(std::span<const Vec3> middles, std::span<const double> widths);

/// The smallest rotation from one direction to another; identity if one of them is zero.
Eigen::Matrix3d least_turn(const Vec3& from, const Vec3& to);

} // namespace lacuna::geometry
