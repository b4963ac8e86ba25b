// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace lacuna::surface {

/// A pair of opposite sides of a face's grid, each given by its edges. Both sides get the same number of mesh
/// sides.
using SidePair = std::array<std::vector<EdgeId>, 2>;

/// Inner angle of a face at the start of use i of its loop [degrees].
double inner_angle(const topology::Model& model, FaceId face, const topology::Loop& loop, std::size_t i);

/// The indices of the edge uses that come right after a corner, where a side of the face starts. Empty if the
/// face has several loops or a reentrant vertex.
std::optional<std::vector<std::size_t>> corners_of(const topology::Model& model, FaceId face);

/// The edges of each side of a face, from corner to corner. Empty if the face has several loops or a
/// reentrant corner.
std::vector<std::vector<EdgeId>> sides_by_corners(const topology::Model& model, FaceId face);

/// Total length of some edges [model length].
double length_of(const topology::Model& model, const std::vector<EdgeId>& edges);

/// The indices of the edge uses with which the four sides of a face start. Empty if the face does not have
/// four sides.
std::optional<std::vector<std::size_t>> four_corners(const topology::Model& model, FaceId face);

/// The two pairs of opposite sides of a four-sided face.
/// @pre  corners from `four_corners()`.
std::vector<SidePair> side_pairs(const topology::Model& model, FaceId face,
                                 const std::vector<std::size_t>& corners);

/// The pairs of edges of a four-sided face that lie opposite each other: both sides have equally many edges
/// of similar lengths, and the lines between their vertices are square to both. If such edges get equal
/// numbers of quads, the rows run straight across the bends of the face.
/// @pre  corners from `four_corners()`.
std::vector<SidePair> opposite_edges(const topology::Model& model, FaceId face,
                                     const std::vector<std::size_t>& corners);

/// The pairs of sides of a rectilinear face: a face whose loops turn by multiples of 90° at its vertices. For
/// each loop and each of the grid's two directions, there is a pair: first the edges of the loop that run in
/// this direction, then the edges that run back. Empty if the angle at a vertex does not fit a grid, or if a
/// loop does not turn by 360° in total.
std::vector<SidePair> grid_sides(const topology::Model& model, FaceId face);

/// Whether a face is a tube that is not cut open: it has two loops and no handle, and its facets face in all
/// directions. Facets of files have no seam, unlike faces of CAD.
bool is_tube(const topology::Model& model, FaceId face);

/// Maximum ratio of the lengths, or of the numbers of quads, of opposite sides of a mapped face. If it is
/// larger, the face is mapped only on request, because the lengths of its quads would have the same ratio.
/// Heuristic.
inline constexpr int kUnlike = 3;

/// Whether the lengths of opposite sides are similar.
bool alike(const topology::Model& model, const std::vector<SidePair>& pairs);

} // namespace lacuna::surface
