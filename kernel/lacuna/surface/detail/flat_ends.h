// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/flat_edges.h>
#include <lacuna/surface/detail/imprint_map.h>

#include <functional>
#include <span>
#include <vector>

/// The inner edges of both ends in one plane, cut at their intersections. Internal to this folder.
namespace lacuna::surface {

struct FlatEnds {
    /// Closed edges of the target that coincide with closed edges of the source are not listed in `target`.
    std::vector<FlatEdge> source, target;
    std::vector<Vec2> place;      ///< position of each node in the plane
    std::vector<VertexId> vertex; ///< for each node, its vertex of the source; not valid if there is none
    std::vector<EdgeId> rim;      ///< edges of the source's rim
};

/// For a position in the plane: the distance within which nodes and edges are merged.
using Reach = std::function<double(const Vec2&)>;

/// An edge of either end in the plane of a map, without cuts.
FlatEdge flat_edge(const topology::Model& model, const EndsMap& map, EdgeId id, bool target);

/// Map the inner edges of both ends to the plane. Nearby vertices and edges are merged, and edges are cut
/// where they cross.
/// @param pairs   vertices of both rims that coincide in the plane.
/// @param inner   edges inside the target.
FlatEnds lay_flat(const topology::OpenVolume& base, const EndsMap& map, std::span<const RimPair> pairs,
                  std::span<const EdgeId> inner, const Reach& reach);

/// A piece of a flat edge between two consecutive cuts.
struct FlatPiece {
    std::size_t edge = 0; ///< index of the edge in `FlatEnds`
    double from_at = 0, to_at = 1;
    std::size_t from = 0, to = 0; ///< nodes
    std::vector<Vec2> line;
    std::vector<double> at;
};

/// @param place  positions of the nodes.
std::vector<FlatPiece> pieces_of(std::span<const FlatEdge> edges, std::span<const Vec2> place);

/// Whether two pieces coincide: the same end nodes, and close to each other throughout.
bool are_one(const FlatPiece& a, const FlatPiece& b, const Reach& reach);

} // namespace lacuna::surface
