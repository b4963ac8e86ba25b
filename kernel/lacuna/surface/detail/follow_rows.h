// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/surface/walls.h>

#include <cstddef>
#include <span>
#include <vector>

/// Void walls that follow the given ones, row by row. Internal to this folder.
namespace lacuna::surface {

/// Nodes first … last of a linking surface that stand on a void face which follows the given walls.
struct FollowedPanel {
    std::size_t link, first, last;
    FaceId face;
};

/// Put the nodes of followed panels where each row's known columns lead the source rim and the target rim,
/// blended by height and moved to meet the panel's sides, and from there on the face: it follows the walls as
/// they were given, and the rows are those of the mesh.
/// @param onto_faces  false: where they are led, which is near the face.
void follow_rows(std::vector<WallMesh>& meshes, const topology::Model& model,
                 std::span<const LinkingNodes> nodes, const std::vector<FollowedPanel>& followed,
                 std::size_t layers, bool onto_faces, const RunContext& context);

} // namespace lacuna::surface
