// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <vector>

/// Edges of a symmetric face that are to have as many sides. Internal to this folder.
namespace lacuna::surface {

/// The edges of a face's loops by what its symmetries map onto each other, each set in the order of the
/// loops. Symmetries are those of the outline laid on the plane across the face's normal.
/// @return  all edges, one that is like no other as a set of its own; none where the face has no symmetry.
std::vector<std::vector<EdgeId>> alike_edges(const topology::Model& model, FaceId face);

} // namespace lacuna::surface
