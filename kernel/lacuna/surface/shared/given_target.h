// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/given_nodes.h>
#include <lacuna/surface/shared/source_mesh.h>

#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// The given mesh of the target, in the numbering of the source's.
struct GivenTarget {
    /// Why the target's given quads are not kept; the lists are then empty. Empty if they are kept, or if
    /// there are none.
    std::string why{};
    std::vector<Vec3> nodes{};  ///< position of each source node: bit for bit the target's own
    std::vector<FaceId> face{}; ///< target face of each source quad
};

/// The given quads of the target, if they form the same graph as the source's: starting from the rim nodes,
/// which correspond by the linking surfaces, quads are paired across their sides.
/// @param wedges  triangles of the target are paired with those of the source.
/// @return  empty if the target has no given quads.
/// @note  O(quads).
GivenTarget given_target(const topology::OpenVolume& volume, std::span<const LinkingSurface> links,
                         const SourceMesh& source, bool wedges = false);

/// If both ends have given quads with the same graph, rotate the loops whose walls do not fix their rotation
/// (round, without columns or side lines). The rotation follows from the graph, starting from a loop whose
/// walls fix its rotation.
/// @param columns  of each linking surface.
/// @note  O(quads of the ends); nothing is done where no loop needs it.
std::vector<LinkingSurface> align_alike_ends(const topology::OpenVolume& volume,
                                             std::span<const GivenColumns> columns,
                                             std::vector<LinkingSurface> links, bool wedges = false);

} // namespace lacuna::surface
