// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>

namespace lacuna {

/// Index of a point, node or cell in an array; -1 means none.
using Index = std::int32_t;

/// An index converted to the size type of the standard containers.
constexpr std::size_t index(Index i) { return static_cast<std::size_t>(i); }

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;

using Segment = std::array<Index, 2>;
using Triangle = std::array<Index, 3>;
using Quad = std::array<Index, 4>;
using Hex = std::array<Index, 8>;

} // namespace lacuna
