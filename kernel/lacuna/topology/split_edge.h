// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::topology {

/// What `split_edge()` made.
struct EdgeSplit {
    VertexId vertex; ///< the new one; tag: the next that no vertex has; origin void
    EdgeId behind;   ///< from it to the end of the old edge; tag: the next free one of its origin
};

/// Split an edge at a fraction of its polyline's length, counted as the edge runs.
///
/// The edge keeps its id and tag up to the new vertex. The vertex gets a point of its own, on the exact curve
/// where there is one at the parameter between its neighbours', and the facets beside it are cut there, with
/// surface parameters between those of their corners. An inner point of the edge that lies within the
/// tolerance becomes the vertex instead; where a face at the edge came with a mesh, whose nodes get none
/// between them, the nearest inner point does, however far. The loops of all faces at the edge go on over
/// both parts, a seam's both ways. A closed edge keeps its vertex too.
///
/// @param fraction  in (0, 1).
/// @throw InvalidInput  a fraction not in (0, 1), or within the tolerance of an end; no inner point where one
///         is needed; names the edge.
/// @note  O(facets of the faces at the edge).
EdgeSplit split_edge(Model& model, EdgeId edge, double fraction);

} // namespace lacuna::topology
