// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>
#include <lacuna/topology/model.h>

#include <map>
#include <span>
#include <vector>

/// Edges of a symmetric face that need equal numbers of sides. Internal to this folder.
namespace lacuna::surface {

/// Divide the edges of a face into classes: the face's symmetries map the edges of one class onto each other.
/// Each class is in the order of the loops. Symmetries are those of the outline in the plane normal to the
/// face's mean normal.
/// @return  classes that contain all edges; an edge without a counterpart is a class of its own. Empty if the
///         face has no symmetry.
std::vector<std::vector<EdgeId>> alike_edges(const topology::Model& model, FaceId face);

/// For each face, the classes of its edges that need equal numbers of sides.
using AlikeEdges = std::map<FaceId, std::vector<std::vector<EdgeId>>>;

/// Request the same number of sides on all edges that a symmetry of a face maps onto each other. This applies
/// only if the wanted numbers of these edges agree and none of them is given.
/// @param faces  faces to treat; a face that keeps its own quads is skipped.
/// @return  the classes of edges whose numbers were made equal.
AlikeEdges ask_alike(Seeds& seeds, const topology::Model& model, std::span<const FaceId> faces);

} // namespace lacuna::surface
