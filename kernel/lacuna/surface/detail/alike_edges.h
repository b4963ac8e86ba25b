// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/seeds.h>
#include <lacuna/topology/model.h>

#include <map>
#include <span>
#include <vector>

/// Edges of a symmetric face that are to have as many sides. Internal to this folder.
namespace lacuna::surface {

/// The edges of a face's loops by what its symmetries map onto each other, each set in the order of the
/// loops. Symmetries are those of the outline laid on the plane across the face's normal.
/// @return  all edges, one that is like no other as a set of its own; none where the face has no symmetry.
std::vector<std::vector<EdgeId>> alike_edges(const topology::Model& model, FaceId face);

/// Sets of edges of each face that are to have as many sides.
using AlikeEdges = std::map<FaceId, std::vector<std::vector<EdgeId>>>;

/// Ask for one number of sides on edges that a face's symmetries map onto each other, where as many are
/// wanted on each of them and none are given.
/// @param faces  those that keep their own quads are left out.
/// @return  the sets of which that was so.
AlikeEdges ask_alike(Seeds& seeds, const topology::Model& model, std::span<const FaceId> faces);

} // namespace lacuna::surface
