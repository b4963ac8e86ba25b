// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <set>

namespace lacuna::surface {

/// Edges that keep their nodes, by themselves or with the mesh of a face.
std::set<EdgeId> kept_edges(const topology::Model& model);

} // namespace lacuna::surface
