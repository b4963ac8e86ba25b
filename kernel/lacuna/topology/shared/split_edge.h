// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace lacuna::topology {

/// The lowest tag above those of all entities with the given origin.
/// @param first  index of the entity at which the search starts
/// @param tag    the result for the entities before `first`
template <class Entity>
int next_tag(const std::vector<Entity>& all, Origin origin, std::size_t first = 0, int tag = 1)
{
    for (std::size_t i = first; i < all.size(); ++i)
        if (all[i].origin == origin) tag = std::max(tag, all[i].tag + 1);
    return tag;
}

/// The parts of an edge that is split at some of its inner points. All parts have the edge's tag.
/// @param at  indices of these points, ascending, each with the vertex that the point becomes.
std::vector<Edge> divided(Edge whole, const std::vector<std::pair<std::size_t, VertexId>>& at);

/// Result of `split_edge()`.
struct EdgeSplit {
    VertexId vertex; ///< the new vertex, with the next free tag; origin void
    EdgeId behind;   ///< from the vertex to the old edge's end, with the next free tag of the edge's origin
};

/// Split an edge at a fraction of its polyline's length, in the edge's direction.
///
/// The edge keeps its id and tag up to the new vertex. The point of the vertex is:
/// - if an adjacent face has a given mesh, whose nodes are fixed: the nearest inner point of the edge;
/// - else an inner point of the edge within the tolerance, if there is one;
/// - else a new point, on the exact curve (`curve_beside()`) if the edge has one. Adjacent facets are split
///   there, with interpolated surface parameters.
///
/// The loops of all adjacent faces then use both parts; the loop of a seam uses them in both directions. A
/// closed edge also keeps its old vertex.
///
/// @param fraction  in (0, 1).
/// @throw InvalidInput  the fraction is not in (0, 1), or the split is within the tolerance of an end; or an
///         inner point is needed and the edge has none. Names the edge.
/// @note  O(facets of the adjacent faces).
EdgeSplit split_edge(Model& model, EdgeId edge, double fraction);

} // namespace lacuna::topology
