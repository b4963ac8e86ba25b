// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/cell_shape.h>
#include <lacuna/mesh/hex_mesh.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace lacuna::mesh {

/// A pyramid or a tetrahedron is stored as a hexahedron whose upper corners are merged: {0, 1, 2, 3, 4, 4, 4,
/// 4} with the base 0-1-2-3, and {0, 1, 2, 2, 3, 3, 3, 3}. The normal of 0-1-2 points to the last corner.
constexpr bool has_apex(const Hex& hex) { return hex[4] == hex[5] && hex[4] == hex[6] && hex[4] == hex[7]; }
constexpr bool is_pyramid(const Hex& hex) { return has_apex(hex) && hex[2] != hex[3]; }
constexpr bool is_tet(const Hex& hex) { return has_apex(hex) && hex[2] == hex[3]; }

/// For a tetrahedron, pyramid, wedge or hexahedron: the index of its corner (in the order of `CellShape`) at
/// each of the eight corners of a hexahedron. @param corners  4, 5, 6 or 8
constexpr Hex merged_corners(int corners)
{
    switch (corners) {
    case 4:
        return {0, 1, 2, 2, 3, 3, 3, 3};
    case 5:
        return {0, 1, 2, 3, 4, 4, 4, 4};
    case 6:
        return {0, 1, 2, 2, 3, 4, 5, 5};
    default:
        return {0, 1, 2, 3, 4, 5, 6, 7};
    }
}

/// The corners of a cell that is stored with merged corners, each once, in the order of `CellShape`.
constexpr CellNodes distinct_corners(const Hex& hex)
{
    CellNodes corners;
    for (const Index n : hex)
        if (corners.count == 0 || corners.node[corners.count - 1] != n) corners.node[corners.count++] = n;
    return corners;
}

/// Convert the nodes of a solid to the form that `quality::measure_cells()` takes. A hexahedron keeps its
/// nodes. Any other shape becomes a hexahedron of 8 or 20 nodes with merged corners. The centre of a
/// pyramid's base, if it is a node, is appended. Middle nodes on the faces of wedges are left out.
/// @param nodes  in the order of `CellShape`.
CellNodes merged_nodes(CellShape shape, std::span<const Index> nodes);

/// A closed surface of triangles and quads, oriented outward.
struct ClosedSkin {
    std::vector<Vec3> points; ///< [model length]
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;
};

/// Cells that fill a closed skin: tetrahedra, and a pyramid on each of its quads.
struct TetMesh {
    std::vector<Vec3> nodes; ///< first the points of the skin, as given
    std::vector<Hex> cells;  ///< stored as `is_tet()` and `is_pyramid()` describe
};

/// Fills a skin; `cad::fill_skin()` does it with Gmsh.
using TetMesher = std::function<TetMesh(const ClosedSkin&, const RunContext&)>;

/// The middle nodes of pyramids and tetrahedra of order 2. Their numbers follow those of the corners.
struct TetMiddles {
    bool full = false;           ///< whether pyramid bases and quads of the skin have a node in their centre
    std::vector<Vec3> nodes;     ///< [model length]
    std::vector<Index> of_cells; ///< middle nodes of all cells, each in the order of `CellShape`
    std::vector<Index> of_skin;  ///< middle nodes of all cells of the skin, each in the order of `CellShape`

    [[nodiscard]] bool empty() const { return nodes.empty(); }
};

/// Pyramids and tetrahedra that fill a volume, or a part of one, with their skin.
struct TetPart {
    std::vector<Vec3> nodes;       ///< the corners [model length]
    std::vector<Hex> cells;        ///< pyramids, then tetrahedra
    std::size_t pyramids = 0;      ///< number of pyramids
    std::vector<Quad> skin;        ///< oriented outward; quads, then triangles as {a, b, c, c}
    std::size_t skin_quads = 0;    ///< number of quads of the skin
    std::vector<Index> skin_patch; ///< patch of each quad and triangle of the skin
    std::vector<SkinPatch> patches;
    std::vector<std::string> volume_groups{"volume"}; ///< the first is the name of the region
    TetMiddles middles;                               ///< empty: the mesh is of order 1

    [[nodiscard]] int order() const { return middles.empty() ? 1 : 2; }
    [[nodiscard]] std::size_t cell_count() const { return cells.size(); }
    [[nodiscard]] std::size_t skin_count() const { return skin.size(); }
    [[nodiscard]] std::size_t node_count() const { return nodes.size() + middles.nodes.size(); }
    [[nodiscard]] const Vec3& node(std::size_t n) const
    {
        return n < nodes.size() ? nodes[n] : middles.nodes[n - nodes.size()];
    }
};

/// Shape of a cell, and of a quad or triangle of the skin.
CellShape cell_shape(const TetPart& mesh, bool is_pyramid);
CellShape skin_shape(const TetPart& mesh, bool is_quad);

/// All nodes of a cell: in the order of `CellShape`, or in the form of the `merged_nodes()` above.
CellNodes cell_nodes(const TetPart& mesh, std::size_t cell);
CellNodes merged_nodes(const TetPart& mesh, std::size_t cell);
/// A quad or triangle of the skin, and all its nodes, as for a `HexMesh`.
inline SkinQuad skin_quad(const TetPart& mesh, std::size_t i) { return {mesh.skin[i], mesh.skin_patch[i]}; }
CellNodes skin_nodes(const TetPart& mesh, std::size_t i);

} // namespace lacuna::mesh
