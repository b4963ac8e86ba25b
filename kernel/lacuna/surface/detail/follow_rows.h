// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/shared/walls.h>

#include <cstddef>
#include <span>
#include <vector>

/// Void walls that follow the given ones, row by row. Internal to this folder.
namespace lacuna::surface {

/// Nodes first … last of a linking surface on a void face that follows the given walls.
struct FollowedPanel {
    std::size_t link, first, last;
    FaceId face;
};

/// Place the nodes of followed panels: each row's known columns define affine maps from the source rim and
/// the target rim, which are blended by height, corrected to meet the panel's sides, and projected onto the
/// face. The face follows the walls as given, the rows follow those of the mesh.
/// @param onto_faces  false: without the projection; the nodes are then near the face.
void follow_rows(std::vector<WallMesh>& meshes, const topology::Model& model,
                 std::span<const LinkingNodes> nodes, const std::vector<FollowedPanel>& followed,
                 std::size_t layers, bool onto_faces, const RunContext& context);

} // namespace lacuna::surface
