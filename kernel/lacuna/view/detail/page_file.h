// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/view/detail/json.h>

#include <span>

namespace lacuna::view {

/// A grid to whose points coordinates are rounded.
struct Grid {
    Vec3 low = Vec3::Zero(), centre = Vec3::Zero();
    double step = 1;   ///< [model length]
    double radius = 1; ///< radius of a ball around the centre that contains everything [model length]
};
/// The grid over a box. Its step is 2^-21 of the largest extent of the box. @pre  the box is not empty
Grid grid_over(const Eigen::AlignedBox3d& box);

/// Write `low`, `centre`, `step`, `radius`, and the colours shared by pages and pictures.
void add_frame(Json& json, const Grid& grid);
/// Write nodes as a value: rounded to the grid, axis by axis, and packed with the given stride.
void add_nodes(Json& json, const Grid& grid, std::span<const Vec3> nodes, std::size_t stride);

/// Assemble the page and write it.
void write_html(const Json& data, const io::OutputPath& path);

} // namespace lacuna::view
