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
    /// Of order 2, the middle nodes from level `first` to level `last`, both with those that lie on them, in
    /// the order of `MiddleNodes::nodes`; else null.
    std::function<void(int first, int last, std::span<Vec3> out, const RunContext& context)> place_middles{};
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

/// All corners of a mesh's cells, held or not.
inline std::size_t corner_count(const HexMesh& mesh)
{
    return (static_cast<std::size_t>(mesh.layers) + 1) * index(mesh.nodes_per_layer);
}

/// Its middle nodes, likewise.
inline std::size_t middle_count(const HexMesh& mesh)
{
    return mesh.order() == 2 ? MiddlePlaces(mesh).count() : 0;
}

/// Layers of cells that are worked on at once: about 250,000 nodes, 6 MB, one layer at least. A choice.
inline int layers_at_once(const HexMesh& mesh)
{
    constexpr std::size_t kNodes = 250000;
    const std::size_t middles = mesh.order() == 2 ? MiddlePlaces(mesh).side(1, 0) : 0;
    const std::size_t layer = std::max<std::size_t>(index(mesh.nodes_per_layer) + middles, 1);
    return std::clamp(static_cast<int>(kNodes / layer), 1, mesh.layers);
}

/// Layers [first, last) as a mesh that holds its nodes and has no patches.
/// @param before  other layers of the same mesh, whose room is taken; empty: none are there
HexMesh make_layers(const LayeredMesh& layered, int first, int last, HexMesh before = {},
                    const RunContext& context = {});

} // namespace lacuna::mesh
