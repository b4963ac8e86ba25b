// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/surface/shared/source_mesh.h>
#include <lacuna/surface/shared/walls.h>
#include <lacuna/sweep/detail/morph_ends.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::sweep {

/// Assign a patch to every quad of a mesh's skin. There is one patch for each face, with the user's groups.
/// @param ends  for each quad, its faces on the source and on the target.
/// @return  face of each patch.
/// @throw NotSweepable "sweep.source_gap"  faces of the source have different nodes along a common edge.
std::vector<FaceId> set_patches(const topology::OpenVolume& volume, const surface::SourceMesh& source,
                                const EndFaces& ends, const std::vector<surface::WallMesh>& walls,
                                mesh::HexMesh& mesh);

} // namespace lacuna::sweep
