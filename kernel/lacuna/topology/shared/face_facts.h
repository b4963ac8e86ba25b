// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::topology {

/// Facts that help to identify a face.
struct FaceFacts {
    Eigen::AlignedBox3d box;        ///< bounding box of its facets
    std::vector<FaceId> neighbours; ///< faces that share an edge with it; ascending
    std::vector<EdgeId> free_edges; ///< edges that no other face uses, except seams; ascending
    std::size_t part = 0;           ///< number of the connected part of the model that contains it, from 0
};

/// Bounding box of a face's facets.
Eigen::AlignedBox3d box_of(const Model& model, FaceId face);

/// Number of edges around a face; a seam counts twice.
std::size_t edge_count(const Face& face);

/// The facts of each face. O(facets + edges log edges).
std::vector<FaceFacts> face_facts(const Model& model);

} // namespace lacuna::topology
