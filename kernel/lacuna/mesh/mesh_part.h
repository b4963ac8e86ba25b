// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/hex_mesh.h>

#include <span>

namespace lacuna::mesh {

/// One of several swept meshes that have nodes in common.
struct MeshPart {
    const HexMesh* mesh = nullptr;
    /// Of each node, its number in the whole, from 0: a new one is the next, one of an earlier part has that
    /// one's.
    std::span<const Index> number;
};

} // namespace lacuna::mesh
