// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

#include <cstddef>
#include <vector>

namespace lacuna::topology {

/// What tells a face from others, beside its shape.
struct FaceFacts {
    Eigen::AlignedBox3d box;        ///< of its facets
    std::vector<FaceId> neighbours; ///< that share an edge with it; rising
    std::vector<EdgeId> free_edges; ///< that no other face has, seams left out; rising
    std::size_t part = 0;           ///< which of the parts that hang together, from 0
};

/// Of each face. O(facets + edges log edges).
std::vector<FaceFacts> face_facts(const Model& model);

} // namespace lacuna::topology
