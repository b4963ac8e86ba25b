// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/given_nodes.h>
#include <lacuna/surface/source_mesh.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lacuna::surface {

/// The mesh that the target came with, in the numbers of the source's.
struct GivenTarget {
    std::vector<Vec3> nodes;  ///< where each source node goes, bit for bit the target's own
    std::vector<FaceId> face; ///< target face of each source quad
};

/// The target's given quads, where they are the same graph as the source's: from the nodes of the rims, which
/// go together by the linking surfaces, quads are paired over their sides.
/// @param wedges  triangles of the target are paired with those of the source.
/// @param why  out: what differs, where nothing is returned and the target came with quads; else empty.
/// @note  O(quads).
std::optional<GivenTarget> given_target(const topology::OpenVolume& volume,
                                        std::span<const LinkingSurface> links, const SourceMesh& source,
                                        std::string& why, bool wedges = false);

/// Where both ends came with quads of the same graph: turn the loops whose walls do not say how they turn
/// (round, without columns or side lines) as the graph leads to them from one whose walls do.
/// @param columns  of each linking surface.
/// @note  O(quads of the ends); nothing is done where no loop needs it.
void align_alike_ends(const topology::OpenVolume& volume, std::span<const GivenColumns> columns,
                      std::vector<LinkingSurface>& links, bool wedges = false);

} // namespace lacuna::surface
