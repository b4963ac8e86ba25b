// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/types.h>
#include <lacuna/mesh/hex_mesh.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

namespace lacuna::mesh {

/// The nodes of a swept mesh that does not hold them: made a few layers at a time, whenever they are asked
/// for, the same each time to the bit.
///
/// Such a mesh is a `HexMesh` whose `nodes` are those of the source alone; all else of it is there.
struct LayeredNodes {
    /// Nodes of levels [first, last), 0 the source and `layers` the target, into (last - first) ×
    /// nodes_per_layer places.
    std::function<void(int first, int last, std::span<Vec3> out, const RunContext& context)> place;
    /// A node of the skin, by its number in the mesh.
    std::function<Vec3(Index node)> on_skin;
};

/// A swept mesh whose nodes are made when they are asked for. Refers to both.
struct LayeredMesh {
    const HexMesh& mesh;
    const LayeredNodes& nodes;
};

/// Nodes of the skin of a mesh, whether it holds them or not. Refers to both.
struct SkinNodes {
    const HexMesh& mesh;
    const LayeredNodes* layers = nullptr; ///< null: the mesh holds its nodes

    [[nodiscard]] Vec3 operator[](Index node) const
    {
        return layers != nullptr ? layers->on_skin(node) : mesh.node(index(node));
    }
};

/// All nodes of a mesh, held or not.
inline std::size_t corner_count(const HexMesh& mesh)
{
    return (static_cast<std::size_t>(mesh.layers) + 1) * index(mesh.nodes_per_layer);
}

/// Layers of cells that are worked on at once: about 250,000 nodes, 6 MB, one layer at least. A choice.
inline int layers_at_once(const HexMesh& mesh)
{
    constexpr Index kNodes = 250000;
    return std::clamp(kNodes / std::max<Index>(mesh.nodes_per_layer, 1), Index{1}, Index{mesh.layers});
}

} // namespace lacuna::mesh
