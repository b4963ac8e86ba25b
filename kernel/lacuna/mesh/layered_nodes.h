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

/// Functions that compute the nodes of a swept mesh on demand, a few layers at a time. Repeated calls return
/// the same nodes, bit for bit. The `HexMesh` itself is complete, except that its `nodes` are those of the
/// source only.
struct LayeredNodes {
    /// Compute the nodes of levels [first, last) into `out`, (last - first) × nodes_per_layer points. Level 0
    /// is the source, level `layers` the target.
    std::function<void(int first, int last, std::span<Vec3> out, const RunContext& context)> place;
    /// A node of the skin, by its number.
    std::function<Vec3(Index node)> on_skin;
    /// Compute the middle nodes from level `first` to level `last`, including those on both levels, in the
    /// order of `MiddleNodes::nodes`. Null for a mesh of order 1.
    std::function<void(int first, int last, std::span<Vec3> out, const RunContext& context)> place_middles{};
};

/// A swept mesh whose nodes are computed on demand. Holds references only.
struct LayeredMesh {
    const HexMesh& mesh;
    const LayeredNodes& nodes;
};

/// Access to the skin nodes of a mesh, whether it stores its nodes or not. Holds references only.
struct SkinNodes {
    const HexMesh& mesh;
    const LayeredNodes* layers = nullptr; ///< null: the mesh stores its nodes

    [[nodiscard]] Vec3 operator[](Index node) const
    {
        return layers != nullptr ? layers->on_skin(node) : mesh.node(index(node));
    }
};

/// Number of cell corners of a mesh, stored or not.
inline std::size_t corner_count(const HexMesh& mesh)
{
    return (static_cast<std::size_t>(mesh.layers) + 1) * index(mesh.nodes_per_layer);
}

/// Number of middle nodes of a mesh, stored or not.
inline std::size_t middle_count(const HexMesh& mesh)
{
    return mesh.order() == 2 ? MiddlePlaces(mesh).count() : 0;
}

/// Number of layers to process at once: about 250,000 nodes (6 MB), at least one layer.
inline int layers_at_once(const HexMesh& mesh)
{
    constexpr std::size_t kNodes = 250000;
    const std::size_t middles = mesh.order() == 2 ? MiddlePlaces(mesh).side(1, 0) : 0;
    const std::size_t layer = std::max<std::size_t>(index(mesh.nodes_per_layer) + middles, 1);
    return std::clamp(static_cast<int>(kNodes / layer), 1, mesh.layers);
}

/// Layers [first, last) as a mesh that stores its nodes and has no patches.
/// @param before  result of an earlier call, whose memory is reused; may be empty
HexMesh make_layers(const LayeredMesh& layered, int first, int last, HexMesh before = {},
                    const RunContext& context = {});

} // namespace lacuna::mesh
