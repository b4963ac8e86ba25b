// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <vector>

namespace lacuna::matching {

/// Points that stand for a loop in a fit. A choice, not a measurement: a start is slid to its place
/// afterwards.
inline constexpr std::size_t kSamples = 64;

/// A loop as matching sees it.
struct LoopShape {
    std::vector<VertexId> vertices;
    std::vector<Vec3> points;       ///< polyline, closed: first repeated at the end
    std::vector<double> arc;        ///< running length of `points`
    std::vector<double> vertex_arc; ///< running length at each vertex
    std::vector<bool> corner;       ///< of each vertex: the loop turns there
    Vec3 centroid = Vec3::Zero();
    Vec3 area = Vec3::Zero();
    double length = 0;
};

LoopShape shape_of(const topology::Model& model, const topology::Rim& rim);

/// Sample a loop evenly from a running length on.
std::vector<Vec3> even_samples(const LoopShape& shape, double start, bool backward);

/// Sample a loop from vertex `start` on, as many points on each edge, so that vertex meets vertex.
std::vector<Vec3> edge_samples(const LoopShape& shape, std::size_t start, bool backward);

} // namespace lacuna::matching
