// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/geometry/affine.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <limits>
#include <vector>

namespace lacuna::matching {

/// Points that stand for a loop in a fit.
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

/// True for loops that are paired by length: their vertices do not tell how they lie on each other.
bool by_length(const LoopShape& source, const LoopShape& target);

/// One way to lay a source loop on a target loop.
struct Lay {
    std::size_t shift =
        0; ///< target vertex that the source's first vertex meets; of loops paired by length the sample
    bool backward = true; ///< the target loop is walked against its own direction
    double score = std::numeric_limits<double>::infinity();
    geometry::RigidFit fit;
};

/// Corresponding points of two loops, as a lay has it.
std::vector<Vec3> source_samples(const LoopShape& source, const LoopShape& target);
std::vector<Vec3> target_samples(const LoopShape& source, const LoopShape& target, std::size_t shift,
                                 bool backward);

/// True where two lays are not the same but for a little sliding along a smooth loop.
bool differ(const LoopShape& source, const LoopShape& target, const Lay& a, const Lay& b);

/// How much two loops, run as a lay has it, look opposite ways along the line between them, 0…1: a plain sweep goes
/// into both alike.
double overturned(const LoopShape& source, const LoopShape& target, bool backward);

} // namespace lacuna::matching
