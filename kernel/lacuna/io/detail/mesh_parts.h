// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/detail/cell_shapes.h>
#include <lacuna/io/detail/swept_view.h>
#include <lacuna/mesh/mesh_part.h>
#include <lacuna/mesh/tet_mesh.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Common interface of swept meshes and tetrahedra: cells and skin by shape, and their nodes. Internal to
/// this folder.
namespace lacuna::io {

/// Positions [begin, end) of the cells, or of the sides of the skin, of one shape.
struct OfShape {
    DeckShape shape;
    std::size_t begin, end;
};
using ByShape = std::array<OfShape, 2>;

/// A swept mesh. Its cells and skin are not stored by shape, so positions are converted to indices.
struct SweptParts {
    const mesh::HexMesh& mesh;
    mesh::CellKinds kinds{mesh};

    [[nodiscard]] ByShape cells() const
    {
        return {
            {{cell_shape(mesh), 0, kinds.hexes()}, {DeckShape::wedge6, kinds.hexes(), mesh.cell_count()}}};
    }
    [[nodiscard]] ByShape skin() const
    {
        return {{{skin_shape(mesh), 0, kinds.skin_quads()},
                 {DeckShape::tri3, kinds.skin_quads(), mesh.skin_count()}}};
    }
    [[nodiscard]] std::size_t cell(std::size_t i) const { return kinds.cell(i); }
    [[nodiscard]] std::size_t side(std::size_t i) const { return kinds.skin(i); }
    [[nodiscard]] mesh::CellNodes cell_nodes(std::size_t c) const { return mesh::cell_nodes(mesh, c); }
    [[nodiscard]] mesh::CellNodes skin_nodes(std::size_t i) const { return mesh::skin_nodes(mesh, i); }
    [[nodiscard]] Quad skin_quad(std::size_t i) const { return mesh::skin_quad(mesh, i).nodes; }
    [[nodiscard]] Index patch(std::size_t i) const { return mesh::skin_quad(mesh, i).patch; }
    /// For each side of the skin: its cell, and the number of that face in the cell.
    [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<int>> behind_skin() const;
    [[nodiscard]] std::size_t nodes() const { return mesh::corner_count(mesh) + mesh::middle_count(mesh); }
    /// All nodes of the columns over nodes of the first level.
    [[nodiscard]] std::vector<Index> nodes_over(std::span<const Index> first) const;
    void check() const { check_skin(mesh); }
};

/// Pyramids and tetrahedra.
struct TetParts {
    const mesh::TetPart& mesh;

    [[nodiscard]] ByShape cells() const
    {
        return {{{mesh::cell_shape(mesh, true), 0, mesh.pyramids},
                 {mesh::cell_shape(mesh, false), mesh.pyramids, mesh.cells.size()}}};
    }
    [[nodiscard]] ByShape skin() const
    {
        return {{{mesh::skin_shape(mesh, true), 0, mesh.skin_quads},
                 {mesh::skin_shape(mesh, false), mesh.skin_quads, mesh.skin.size()}}};
    }
    [[nodiscard]] static std::size_t cell(std::size_t i) { return i; }
    [[nodiscard]] static std::size_t side(std::size_t i) { return i; }
    [[nodiscard]] mesh::CellNodes cell_nodes(std::size_t c) const { return mesh::cell_nodes(mesh, c); }
    [[nodiscard]] mesh::CellNodes skin_nodes(std::size_t i) const { return mesh::skin_nodes(mesh, i); }
    [[nodiscard]] Quad skin_quad(std::size_t i) const { return mesh.skin[i]; }
    [[nodiscard]] Index patch(std::size_t i) const { return mesh.skin_patch[i]; }
    /// As for swept meshes.
    [[nodiscard]] std::pair<std::vector<std::uint32_t>, std::vector<int>> behind_skin() const;
    [[nodiscard]] std::size_t nodes() const { return mesh.node_count(); }
    [[nodiscard]] static std::vector<Index> nodes_over(std::span<const Index>) { return {}; }
    static void check() {}
};

/// The format's word for elements of a shape; empty: the format needs none.
inline std::string type_word(DeckFormat format, DeckShape shape)
{
    const ShapeWords& words = words_of(shape);
    return format == DeckFormat::unv       ? std::to_string(words.unv)
           : format == DeckFormat::nastran ? words.nastran
           : format == DeckFormat::abaqus  ? words.abaqus
                                           : "";
}

} // namespace lacuna::io
