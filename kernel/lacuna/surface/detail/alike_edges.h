// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>
#include <lacuna/topology/model.h>

#include <map>
#include <span>
#include <vector>

/// Edges of a symmetric face that need equal numbers of sides. Internal to this folder.
namespace lacuna::surface {

/// Classes of a face's edges under its symmetries, each in the order of the loops. Symmetries are those of
/// the outline in the plane normal to the face's normal.
/// @return  all edges, one without a counterpart as a class of its own; empty if the face has no symmetry.
std::vector<std::vector<EdgeId>> alike_edges(const topology::Model& model, FaceId face);

/// Classes of edges of each face that need equal numbers of sides.
using AlikeEdges = std::map<FaceId, std::vector<std::vector<EdgeId>>>;

/// Set one number of sides on edges that a face's symmetries map onto each other, if their wanted numbers
/// agree and none is given.
/// @param faces  those that keep their own quads are skipped.
/// @return  the classes to which this applied.
AlikeEdges ask_alike(Seeds& seeds, const topology::Model& model, std::span<const FaceId> faces);

} // namespace lacuna::surface
