// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::surface {

/// The edges of two sides of a face that a grid over it runs between: both have as many sides of quads.
using SidePair = std::array<std::vector<EdgeId>, 2>;

/// Inner angle of a face where use i of its loop starts [degrees].
double inner_angle(const topology::Model& model, FaceId face, const topology::Loop& loop, std::size_t i);

/// The uses that start a side, after a corner; nothing where the face has several loops or is bent inward at
/// a vertex.
std::optional<std::vector<std::size_t>> corners_of(const topology::Model& model, FaceId face);

/// The edges of a face's sides between corners; none where it has several loops or a corner bends inward.
std::vector<std::vector<EdgeId>> sides_by_corners(const topology::Model& model, FaceId face);

/// Length of some edges together [model length].
double length_of(const topology::Model& model, const std::vector<EdgeId>& edges);

/// The uses that start the four sides of a face; nothing when it has not four.
std::optional<std::vector<std::size_t>> four_corners(const topology::Model& model, FaceId face);

/// The two pairs of sides of a face with four.
/// @pre  corners from `four_corners()`.
std::vector<SidePair> side_pairs(const topology::Model& model, FaceId face,
                                 const std::vector<std::size_t>& corners);

/// The pairs of sides of a face whose loops turn by right angles at vertices, as a polygon of squares does:
/// of each loop what runs one way and what runs back. None where a vertex's angle fits no grid, or a loop
/// does not turn once about.
std::vector<SidePair> grid_sides(const topology::Model& model, FaceId face);

/// Whether no side is much longer than the one opposite.
bool alike(const topology::Model& model, const std::vector<SidePair>& pairs);

} // namespace lacuna::surface
