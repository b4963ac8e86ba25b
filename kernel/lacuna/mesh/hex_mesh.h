// SPDX-License-Identifier: MIT
#pragma once

// In: quads, layers and node positions that `sweep` computes; out: meshes as arrays, and views of them for
// writers.
//
// Where to change things:
//   corners and sides of cells; patches of the skin  hex_mesh.h, quad_mesh.h
//   neighbours of quads; quads of the skin           mesh.cpp
//   shapes of cells, order of their nodes            cell_shape.cpp
//   numbering of middle nodes                        second_order.cpp
//   tetrahedra and pyramids                          tet_mesh.cpp
//   nodes that are computed on demand                layered_nodes.cpp
//   common numbering of several meshes               mesh_part.h
//   what a writer sees                               shared/mesh_view.h, mesh_view.cpp
//   directions of cells                              orientation.cpp

#include <lacuna/core/types.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/mesh/second_order.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::mesh {

///        7-------6
///       /|      /|      Nodes of a hexahedron (Gmsh's order). 0..3 lie on the source side,
///      4-------5 |      4..7 above them on the next layer; the normal of 0-1-2-3 points to 4-5-6-7.
///      | 3-----|-2      w
///      |/      |/       | v
///      0-------1        |/__u
///
/// Corners of each of the six sides, ordered outward.
inline constexpr std::array<Quad, 6> kHexSides{{
    {0, 3, 2, 1},
    {4, 5, 6, 7},
    {0, 1, 5, 4},
    {1, 2, 6, 5},
    {2, 3, 7, 6},
    {3, 0, 4, 7},
}};

/// Neighbours of each corner along u, v and w.
inline constexpr std::array<std::array<std::size_t, 3>, 8> kHexNeighbours{
    {{1, 3, 4}, {0, 2, 5}, {3, 1, 6}, {2, 0, 7}, {5, 7, 0}, {4, 6, 1}, {7, 5, 2}, {6, 4, 3}}};

///        5           Nodes of a wedge (Gmsh's order): 0..2 lie on the source side, 3..5 above them.
///       /|\          Functions that take hexahedra get a wedge as a hexahedron whose last two columns of
///      3---4         nodes are merged: {0, 1, 2, 2, 3, 4, 5, 5}.
///      | 2 |
///      |/ \|
///      0---1
///
using Wedge = std::array<Index, 6>;

constexpr bool is_wedge(const Hex& hex) { return hex[2] == hex[3] && hex[6] == hex[7]; }
/// Neighbours of each corner of a wedge that is stored as a hexahedron: two in its triangle and one along its
/// height, right-handed as in `kHexNeighbours`. Corners 3 and 7 are the same as 2 and 6.
inline constexpr std::array<std::array<std::size_t, 3>, 8> kWedgeNeighbours{
    {{1, 2, 4}, {2, 0, 5}, {0, 1, 6}, {0, 1, 6}, {6, 5, 0}, {4, 6, 1}, {5, 4, 2}, {5, 4, 2}}};

/// @pre is_wedge(hex)
constexpr Wedge wedge_of(const Hex& hex) { return {hex[0], hex[1], hex[2], hex[4], hex[5], hex[6]}; }
constexpr Hex hex_of(const Wedge& wedge)
{
    return {wedge[0], wedge[1], wedge[2], wedge[2], wedge[3], wedge[4], wedge[5], wedge[5]};
}

/// A named part of the skin: a surface entity in Gmsh's terms.
struct SkinPatch {
    int tag = 0; ///< entity tag written to files, unique in the mesh, > 0
    /// Physical groups of the patch: "source", "wall:12", a name of the input… Formats that allow one group
    /// per quad use the first.
    std::vector<std::string> groups;
    int face = 0; ///< tag of the given face that it lies on; 0: a void face, or unknown
};

/// Swept hexahedra, stored as source quads and a number of layers: cells and skin are computed, not stored.
/// Triangles of the source are swept to wedges.
///
/// Node (layer l, source node n) has the number l · nodes_per_layer + n, counted from 0. Cell (layer l,
/// quad q) has the number l · quads.size() + q.
struct HexMesh {
    Index nodes_per_layer = 0;
    int layers = 0;
    std::vector<Vec3> nodes;  ///< (layers + 1) × nodes_per_layer, layer-major from the source [model length]
    std::vector<Quad> quads;  ///< source quads, then source triangles; normals point into the volume
    std::vector<Segment> rim; ///< boundary sides of `quads`, directed as in their quad

    std::vector<SkinPatch> patches;
    std::vector<Index> source_patch; ///< patch of each quad on the source
    std::vector<Index> target_patch; ///< patch of each quad on the target
    std::vector<Index> wall_patch;   ///< patch of (rim side r, layer l) at l · rim.size() + r
    std::vector<std::string> volume_groups{"volume"}; ///< the first is the name of the region
    MiddleNodes middles;                              ///< empty: cells of order 1

    [[nodiscard]] int order() const { return middles.empty() ? 1 : 2; }
    /// Number of corners and middle nodes. Middle nodes are numbered after the corners.
    [[nodiscard]] std::size_t node_count() const { return nodes.size() + middles.nodes.size(); }
    [[nodiscard]] const Vec3& node(std::size_t n) const
    {
        return n < nodes.size() ? nodes[n] : middles.nodes[n - nodes.size()];
    }
    /// Number of hexahedra and wedges.
    [[nodiscard]] std::size_t cell_count() const { return quads.size() * static_cast<std::size_t>(layers); }
    /// Number of triangles of the source. O(triangles), like `hex_count()` and `wedge_count()`.
    [[nodiscard]] std::size_t triangle_count() const
    {
        std::size_t count = 0;
        while (count < quads.size() && is_triangle(quads[quads.size() - 1 - count])) ++count;
        return count;
    }
    [[nodiscard]] std::size_t hex_count() const { return cell_count() - wedge_count(); }
    [[nodiscard]] std::size_t wedge_count() const
    {
        return triangle_count() * static_cast<std::size_t>(layers);
    }
    [[nodiscard]] std::size_t skin_count() const
    {
        return 2 * quads.size() + rim.size() * static_cast<std::size_t>(layers);
    }
    /// Node numbers of a cell; a wedge is stored as `is_wedge()` says. @pre cell < cell_count()
    [[nodiscard]] Hex hex(std::size_t cell) const
    {
        const auto layer = static_cast<Index>(cell / quads.size());
        const Quad& q = quads[cell % quads.size()];
        const Index low = layer * nodes_per_layer;
        const Index high = low + nodes_per_layer;
        return {low + q[0],  low + q[1],  low + q[2],  low + q[3],
                high + q[0], high + q[1], high + q[2], high + q[3]};
    }
};

/// A quad or triangle of the skin, oriented outward, with its patch.
struct SkinQuad {
    Quad nodes;
    Index patch;
};

/// Numbering of cells and skin by kind, as in files: hexahedra before wedges, quads before triangles. It
/// needs no arrays, because triangles come last in `HexMesh::quads`.
class CellKinds {
public:
    explicit CellKinds(const HexMesh& mesh)
        : columns_(mesh.quads.size()),
          triangles_(mesh.triangle_count()),
          hexes_(mesh.hex_count()),
          walls_(mesh.skin_count() - 2 * columns_)
    {
    }
    [[nodiscard]] std::size_t hexes() const { return hexes_; }
    [[nodiscard]] std::size_t skin_quads() const { return 2 * (columns_ - triangles_) + walls_; }
    /// The cell at position `i` of this numbering.
    [[nodiscard]] std::size_t cell(std::size_t i) const
    {
        if (triangles_ == 0) return i;
        const std::size_t own = i < hexes_ ? columns_ - triangles_ : triangles_;
        const std::size_t at = i < hexes_ ? i : i - hexes_;
        return at / own * columns_ + (i < hexes_ ? 0 : columns_ - triangles_) + at % own;
    }
    /// The skin quad or triangle at position `i` of this numbering.
    [[nodiscard]] std::size_t skin(std::size_t i) const
    {
        const std::size_t quads = columns_ - triangles_;
        if (i < quads) return i;
        if (i < skin_quads()) return i < 2 * quads ? i + triangles_ : i + 2 * triangles_;
        const std::size_t at = i - skin_quads();
        return at < triangles_ ? quads + at : columns_ + quads + (at - triangles_);
    }

private:
    std::size_t columns_, triangles_, hexes_, walls_;
};

/// Skin quad `i`: first those on the source, then the target, then the walls, layer by layer.
/// @pre i < skin_count()
SkinQuad skin_quad(const HexMesh& mesh, std::size_t i);

} // namespace lacuna::mesh
