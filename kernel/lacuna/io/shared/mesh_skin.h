// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::io {

/// The skin of a swept mesh as faces with given quads, one for each patch.
struct MeshSkin {
    topology::OpenVolume volume; ///< closed; all its faces are walls, and have the tags and names of the
                                 ///< patches
    std::vector<FaceId> face;    ///< the face of each patch
};

/// @throw InvalidInput "io.skin_in_pieces"  a patch has no quads, or its quads are not connected.
/// @note  O(n log n) in the quads of the skin.
MeshSkin skin_of(const mesh::HexMesh& mesh, const RunContext& context = {});

} // namespace lacuna::io
