// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <string>
#include <vector>

/// What an MSH file says beside nodes and cells: entities and physical groups. Internal to this folder.
namespace lacuna::io {

struct PhysicalName {
    int dimension;
    int tag;
    std::string name;
};

/// A surface entity: a skin patch that has quads.
struct MshSurface {
    int tag = 0;
    std::vector<int> physical; ///< tags of its groups, rising
    Eigen::AlignedBox3d box;
    std::size_t begin = 0, end = 0; ///< its quads in `MshContent::skin`
};

struct MshContent {
    std::vector<PhysicalName> names;
    std::vector<MshSurface> surfaces;
    std::vector<int> volume_physical;
    Eigen::AlignedBox3d box;
    std::vector<std::uint32_t> skin; ///< numbers of all skin quads, patch after patch
};

inline constexpr int kVolumeTag = 1;

/// @throw InvalidInput  a skin quad belongs to no patch, or two patches share a tag.
void check_skin(const mesh::HexMesh& mesh);

/// @throw InvalidInput  as `check_skin()`.
MshContent msh_content(const mesh::HexMesh& mesh);

} // namespace lacuna::io
