// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/detail/flat_edges.h>
#include <lacuna/surface/detail/imprint_map.h>

#include <functional>
#include <span>
#include <vector>

/// The inner edges of both ends in one plane, cut where they meet. Internal to this folder.
namespace lacuna::surface {

struct FlatEnds {
    std::vector<FlatEdge> source, target; ///< without edges of the target that are a closed one of the source
    std::vector<Vec2> place;              ///< of each node
    std::vector<VertexId> vertex;         ///< of each node; none where it is not of the source
    std::vector<EdgeId> rim;              ///< edges of the source's rim
};

/// How near what lies at a place has to be to be one with it.
using Reach = std::function<double(const Vec2&)>;

/// An edge of either end in the plane of a map, without cuts.
FlatEdge flat_edge(const topology::Model& model, const EndsMap& map, EdgeId id, bool target);

/// Lay the inner edges of both ends in the plane of a map. Vertices and edges that are near each other become
/// one, and edges are cut where they cross.
/// @param pairs   vertices of the rims that are one.
/// @param closed  edges that are.
/// @param inner   edges inside the target.
FlatEnds lay_flat(const topology::OpenVolume& base, const EndsMap& map, std::span<const RimPair> pairs,
                  std::span<const ClosedPair> closed, std::span<const EdgeId> inner, const Reach& reach);

/// A part of a flat edge between two cuts that follow each other.
struct FlatPiece {
    std::size_t edge = 0; ///< number of the flat edge
    double from_at = 0, to_at = 1;
    std::size_t from = 0, to = 0; ///< nodes
    std::vector<Vec2> line;
    std::vector<double> at;
};

/// @param place  of each node.
std::vector<FlatPiece> pieces_of(std::span<const FlatEdge> edges, std::span<const Vec2> place);

/// Whether two pieces are one: the same nodes at their ends and near each other all the way.
bool are_one(const FlatPiece& a, const FlatPiece& b, const Reach& reach);

} // namespace lacuna::surface
