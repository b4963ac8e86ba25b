// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/view/detail/json.h>

#include <span>
#include <vector>

namespace lacuna::view {

/// Places as whole numbers of steps from a corner of their box.
struct Grid {
    Vec3 low = Vec3::Zero(), centre = Vec3::Zero();
    double step = 1;   ///< [model length]
    double radius = 1; ///< of a ball about the centre that holds all [model length]
};
/// @pre  boxes that are not empty; the steps are 2^-21 of their largest extent.
Grid grid_over(const Eigen::AlignedBox3d& box);

/// Write `low`, `centre`, `step`, `radius` and the colours that pages and pictures share.
void add_frame(Json& json, const Grid& grid);
/// Write nodes as a value: rounded to the grid, axis by axis, predicted from those `stride` before.
void add_nodes(Json& json, const Grid& grid, std::span<const Vec3> nodes, std::size_t stride);

/// Put the page together and write it.
void write_html(const Json& data, const io::OutputPath& path);

} // namespace lacuna::view
