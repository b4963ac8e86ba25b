// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <set>
#include <vector>

namespace lacuna::matching {

/// Number of nearest loops whose samples take part in the fit of a loop. If all loops took part, the cost of
/// each fit would grow with the number of loops.
inline constexpr std::size_t kNearLoops = 8;

/// Geometry of a loop for matching.
struct LoopShape {
    std::vector<VertexId> vertices;
    std::vector<Vec3> points;       ///< closed polyline; the first point is repeated at the end
    std::vector<double> arc;        ///< running length at each of `points`; after count_by_sides() every side
                                    ///< counts as equally long
    std::vector<double> vertex_arc; ///< running length at each vertex
    std::vector<bool> corner;       ///< by vertex: whether the loop has a corner there
    std::vector<std::size_t> sides; ///< by vertex: number of given sides on the edge after it; 0: none given
    Vec3 centroid = Vec3::Zero();
    Vec3 area = Vec3::Zero();
    double length = 0;
    bool by_sides = false; ///< whether count_by_sides() was called
};

/// @param kept  topology::kept_edges() of the model
LoopShape shape_of(const topology::Model& model, const topology::Rim& rim, const std::set<EdgeId>& kept);

/// Index of the place, among `count` places of a loop, that is paired with place `i` of another loop, for a
/// given cyclic shift and direction.
inline std::size_t partner_place(std::size_t i, std::size_t count, std::size_t shift, bool backward)
{
    return (backward ? shift + count - i : shift + i) % count;
}

/// Number of sides of a loop if all its edges have given sides; otherwise 0.
std::size_t given_sides(const LoopShape& shape);

/// Index of the first given side of each edge of a loop, from 0.
std::vector<std::size_t> first_sides(const LoopShape& shape);

/// Change the running lengths so that all given sides count as equally long; the length of the loop stays.
/// Nodes of loops with equal numbers of sides then correspond.
/// @pre  given_sides() is not 0.
void count_by_sides(LoopShape& shape);

/// Sample a loop evenly, starting at a running length.
std::vector<Vec3> even_samples(const LoopShape& shape, double start, bool backward);

/// Sample a loop from vertex `start`, with the same number of points on each edge, so that vertices
/// correspond.
std::vector<Vec3> edge_samples(const LoopShape& shape, std::size_t start, bool backward);

} // namespace lacuna::matching
