// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/node_reader.h>
#include <lacuna/io/partition.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

/// Views of swept meshes, stored or created while they are written. Internal to this folder.
namespace lacuna::io {

/// The cells of a mesh by kind: hexahedra, wedges, quads of the skin, triangles of the skin.
class SweptCells {
public:
    explicit SweptCells(const mesh::HexMesh& own)
        : mesh(own),
          kinds(own),
          triangles(own.triangle_count()),
          quads(own.quads.size() - triangles),
          count{kinds.hexes(), own.cell_count() - kinds.hexes(), 2 * quads + rims(own.layers), 2 * triangles}
    {
    }

    [[nodiscard]] std::size_t rims(int of) const { return index(of) * mesh.rim.size(); }
    [[nodiscard]] std::size_t cell(std::size_t kind, std::size_t i) const
    {
        return kinds.cell(kind == 0 ? i : kinds.hexes() + i);
    }
    /// The index in the skin of the `i`-th quad (kind 2) or triangle (kind 3).
    [[nodiscard]] std::size_t skin(std::size_t kind, std::size_t i) const
    {
        return kinds.skin(kind == 3 ? kinds.skin_quads() + i : i);
    }
    /// Write the nodes of the cells [begin, end) of a kind. @return  the end of the nodes written
    Index* put_nodes(std::size_t kind, std::size_t begin, std::size_t end, Index* out) const;
    [[nodiscard]] std::array<DeckShape, 4> shapes() const
    {
        return {cell_shape(mesh), DeckShape::wedge6, skin_shape(mesh), DeckShape::tri3};
    }
    /// The number of cells of a kind in one layer. @pre kind < 2
    [[nodiscard]] std::size_t in_layer(std::size_t kind) const { return kind == 0 ? quads : triangles; }

    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds;
    std::size_t triangles, quads; ///< numbers of triangles and quads of the source
    std::array<std::size_t, 4> count;

private:
    Index* put_hexes(std::size_t begin, std::size_t end, Index* out) const;
};

/// @throw InvalidInput  a skin quad belongs to no patch, or two patches have the same tag.
void check_skin(const mesh::HexMesh& mesh);

/// View a mesh as blocks of hexahedra, wedges, skin quads and skin triangles. It has one entity for each
/// patch, in the order of the patches, and then one for the volume. The arguments must outlive the view.
/// @throw InvalidInput  as `check_skin()`.
std::shared_ptr<mesh::MeshView> view_of(const mesh::HexMesh& mesh, const NodeReader& nodes,
                                        const std::vector<FieldReader>& fields);

/// Assign the cells to parts by ranges of layers. @throw InvalidInput  as `layer_parts()`.
mesh::ViewParts parts_of(const mesh::HexMesh& mesh, const PartitionOptions& options);

} // namespace lacuna::io
