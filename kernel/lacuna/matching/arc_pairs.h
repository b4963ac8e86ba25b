// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>

#include <utility>
#include <vector>

namespace lacuna::matching {

/// A closed loop by where its vertices stand.
struct ArcLoop {
    std::vector<VertexId> vertices;
    std::vector<double> at;   ///< share of the loop's length at each vertex, in [0, 1)
    std::vector<bool> corner; ///< false for a vertex that only says where a smooth run was cut
};

/// Vertices paired, and places that need a vertex for one to pair with.
struct ArcPairs {
    std::vector<std::pair<VertexId, VertexId>> vertices;   ///< (source, target)
    std::vector<std::pair<VertexId, double>> split_target; ///< source vertex, share of the target's length
    std::vector<std::pair<VertexId, double>> split_source; ///< target vertex, share of the source's length
};

/// Pair the vertices of two loops that have not as many, or that were cut at random, by how far along the loops they stand.
///
/// Hard pairs hold, and shares between them are stretched to meet. Then the closest corners go together while they are nearer than a
/// quarter of a mean side, other vertices where they stand in one place; each source vertex left needs a place on the target, each corner of the target left one on the source.
/// @param offset    share of the target's length where the source's start lies.
/// @param backward  the target runs against the source.
ArcPairs pair_by_arc(const ArcLoop& source, const ArcLoop& target, double offset, bool backward,
                     const std::vector<std::pair<VertexId, VertexId>>& hard);

} // namespace lacuna::matching
