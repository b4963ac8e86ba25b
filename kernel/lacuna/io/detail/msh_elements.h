// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/msh_content.h>
#include <lacuna/io/detail/msh_shapes.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/detail/sections.h>
#include <lacuna/io/partition.h>

#include <string>
#include <vector>

/// What MSH files say of a swept mesh's elements. Internal to this folder.
namespace lacuna::io {

/// Elements of one shape in a row.
struct MshBlock {
    const MshSurface* surface; ///< null: the volume
    DeckShape shape;
    std::size_t first, count; ///< elements of the file before it, and in it

    [[nodiscard]] int type() const { return gmsh_type(shape); }
    [[nodiscard]] std::size_t nodes() const { return static_cast<std::size_t>(shape_info(shape).nodes); }
};

/// What a file says of elements: the skin's, patch after patch, then the cells.
struct MshElements {
    const mesh::HexMesh& mesh;
    const MshContent& content;
    mesh::CellKinds kinds{mesh};

    [[nodiscard]] std::size_t count() const { return content.skin.size() + mesh.cell_count(); }

    [[nodiscard]] std::vector<MshBlock> blocks() const
    {
        std::vector<MshBlock> all;
        const auto add = [&](const MshBlock& block) {
            if (block.count > 0) all.push_back(block);
        };
        for (const MshSurface& surface : content.surfaces) {
            const std::size_t quads = surface.end - surface.begin - surface.triangles;
            add({&surface, skin_shape(mesh), surface.begin, quads});
            add({&surface, DeckShape::tri3, surface.begin + quads, surface.triangles});
        }
        const std::size_t skin = content.skin.size();
        add({nullptr, cell_shape(mesh), skin, kinds.hexes()});
        add({nullptr, DeckShape::wedge6, skin + kinds.hexes(), mesh.cell_count() - kinds.hexes()});
        return all;
    }

    /// Of the element that comes `i`-th, in Gmsh's order.
    [[nodiscard]] mesh::CellNodes nodes(std::size_t i) const
    {
        if (i < content.skin.size()) return skin_nodes(mesh, content.skin[i]);
        mesh::CellNodes nodes = mesh::cell_nodes(mesh, kinds.cell(i - content.skin.size()));
        if (mesh.order() == 1) return nodes;
        const mesh::CellNodes ours = nodes;
        const std::span<const std::uint8_t> places = gmsh_places(cell_shape(mesh));
        for (std::size_t n = 0; n < nodes.count; ++n) nodes.node[places[n]] = ours.node[n];
        return nodes;
    }
};

/// $Entities.
std::string msh_entities(const MshContent& content, bool binary);

/// A file of version 4.1 whose entities are parted by ranges of layers.
std::vector<Section> partitioned_msh(const mesh::HexMesh& mesh, const NodeReader& nodes,
                                     const MshContent& content, const PartitionOptions& options, bool binary);

} // namespace lacuna::io
