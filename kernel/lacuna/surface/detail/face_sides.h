// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::surface {

/// The edges of two opposite sides of a grid over a face; both have the same number of sides of quads.
using SidePair = std::array<std::vector<EdgeId>, 2>;

/// Inner angle of a face at the start of use i of its loop [degrees].
double inner_angle(const topology::Model& model, FaceId face, const topology::Loop& loop, std::size_t i);

/// The uses that start a side, after a corner; empty if the face has several loops or a reentrant vertex.
std::optional<std::vector<std::size_t>> corners_of(const topology::Model& model, FaceId face);

/// The edges of a face's sides between corners; empty if it has several loops or a reentrant corner.
std::vector<std::vector<EdgeId>> sides_by_corners(const topology::Model& model, FaceId face);

/// Total length of some edges [model length].
double length_of(const topology::Model& model, const std::vector<EdgeId>& edges);

/// The uses that start the four sides of a face; nothing if it does not have four.
std::optional<std::vector<std::size_t>> four_corners(const topology::Model& model, FaceId face);

/// The two pairs of sides of a face with four.
/// @pre  corners from `four_corners()`.
std::vector<SidePair> side_pairs(const topology::Model& model, FaceId face,
                                 const std::vector<std::size_t>& corners);

/// The pairs of sides of a rectilinear face, that is, of a face whose loops turn by multiples of a right
/// angle at vertices. Each pair holds the edges of a loop that run in one direction, and those that run back.
/// None if a vertex's angle does not fit a grid, or a loop does not turn exactly once.
std::vector<SidePair> grid_sides(const topology::Model& model, FaceId face);

/// Whether the lengths of opposite sides are similar.
bool alike(const topology::Model& model, const std::vector<SidePair>& pairs);

} // namespace lacuna::surface
