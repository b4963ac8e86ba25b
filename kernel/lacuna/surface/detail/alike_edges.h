// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>
#include <lacuna/topology/model.h>

#include <map>
#include <span>
#include <vector>

/// Edges of a symmetric face that need equal numbers of sides. Internal to this folder.
namespace lacuna::surface {

/// Divide the edges of a face into classes of edges that a symmetry of the face maps onto each other. The
/// symmetries are those of the face's outline, projected along its mean normal.
/// @return  classes that contain all edges, each in the order of the loops. An edge that is mapped onto no
///         other edge is a class of its own. Empty if the face has no symmetry.
std::vector<std::vector<EdgeId>> alike_edges(const topology::Model& model, FaceId face);

/// For each face, the classes of its edges that need equal numbers of sides.
using AlikeEdges = std::map<FaceId, std::vector<std::vector<EdgeId>>>;

/// Request the same number of sides on the edges of each class of `alike_edges()`. A class is left unchanged
/// if the wanted numbers of its edges differ, or if the number of one of its edges is given.
/// @param faces  faces to treat; a face that keeps its own quads is skipped.
/// @return  the classes of edges whose numbers were made equal.
AlikeEdges ask_alike(Seeds& seeds, const topology::Model& model, std::span<const FaceId> faces);

} // namespace lacuna::surface
