// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/topology/open_volume.h>

#include <map>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Makes one patch of the skin, with the user's groups, for each face that has cells.
class FacePatches {
public:
    FacePatches(const topology::OpenVolume& volume, std::vector<mesh::SkinPatch>& patches);

    /// The patch of a face.
    Index of(FaceId face);
    /// The face of each patch.
    [[nodiscard]] const std::vector<FaceId>& faces() const { return faces_; }

private:
    const topology::Model& model_;
    std::vector<mesh::SkinPatch>& patches_;
    std::vector<std::vector<std::string>> groups_; ///< for each face, its groups
    std::vector<FaceId> faces_;
    std::map<FaceId, Index> known_;
};

} // namespace lacuna::sweep
