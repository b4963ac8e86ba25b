// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <set>
#include <vector>

namespace lacuna::matching {

/// Points that stand for a loop in a fit. A choice, not a measurement: a start is slid to its place
/// afterwards.
inline constexpr std::size_t kSamples = 64;

/// A loop as matching sees it.
struct LoopShape {
    std::vector<VertexId> vertices;
    std::vector<Vec3> points;       ///< polyline, closed: first repeated at the end
    std::vector<double> arc;        ///< running length of `points`, or as count_by_sides() has it
    std::vector<double> vertex_arc; ///< running length at each vertex
    std::vector<bool> corner;       ///< of each vertex: the loop turns there
    std::vector<std::size_t> sides; ///< of the edge from each vertex on: its given sides, 0: none are given
    Vec3 centroid = Vec3::Zero();
    Vec3 area = Vec3::Zero();
    double length = 0;
    bool by_sides = false; ///< count_by_sides() was called
};

/// @param kept  topology::kept_edges() of the model
LoopShape shape_of(const topology::Model& model, const topology::Rim& rim, const std::set<EdgeId>& kept);

/// Number of sides of a loop whose edges all came with sides; 0 where some did not.
std::size_t given_sides(const LoopShape& shape);

/// The number of the first given side of each edge of a loop, from 0.
std::vector<std::size_t> first_sides(const LoopShape& shape);

/// Take every given side for as long as the others: loops that came with as many are then the same all along.
/// @pre given_sides()
void count_by_sides(LoopShape& shape);

/// Sample a loop evenly from a running length on.
std::vector<Vec3> even_samples(const LoopShape& shape, double start, bool backward);

/// Sample a loop from vertex `start` on, as many points on each edge, so that vertex meets vertex.
std::vector<Vec3> edge_samples(const LoopShape& shape, std::size_t start, bool backward);

} // namespace lacuna::matching
