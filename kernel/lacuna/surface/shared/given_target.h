// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/surface/shared/source_mesh.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// The given mesh of the target, in the node order of the source's mesh.
struct GivenTarget {
    /// The reason why the target's given quads are not kept; `nodes` and `face` are then empty. If there is
    /// no reason, the quads are kept or there are none.
    std::string why{};
    std::vector<Vec3> nodes{};  ///< target position of each source node, bit for bit as given
    std::vector<FaceId> face{}; ///< target face of each source quad
};

/// The given quads of the target, if they form the same graph as the source's quads. Rim nodes correspond by
/// the linking surfaces; starting from the rims, quads are paired across their sides.
/// @param wedges  whether triangles of the target are paired with triangles of the source.
/// @return  empty if the target has no given quads.
/// @note  O(quads).
GivenTarget given_target(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                         const SourceMesh& source, bool wedges = false);

/// Rotate round loops so that given quads of both ends correspond. This applies if both ends have given quads
/// with the same graph, and to loops whose walls have neither columns nor side lines and therefore do not fix
/// the rotation. The search starts from a loop whose walls fix its rotation.
/// @param columns  given columns of each linking surface.
/// @note  O(quads of the ends); nothing is done if the walls fix the rotation of every loop.
std::vector<LinkingSurface> align_alike_ends(const topology::OpenVolume& volume,
                                             std::span<const GivenColumns> columns,
                                             std::vector<LinkingSurface> links, bool wedges = false);

} // namespace lacuna::surface
