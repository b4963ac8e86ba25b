// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::mesh {

struct HexMesh;

/// Nodes of a hexahedron of order 2 in the order of VTK and Abaqus: the corners as in `Hex`, the edge nodes
/// in the order of `kHexEdges`, the face nodes in the order of `kHexFaces`, the centre. A hex20 has the first
/// twenty, a hex27 all.
///
/// Corners of each of the twelve edges.
inline constexpr std::array<Segment, 12> kHexEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
/// Corners of each of the six faces, in the order u = 0, u = 1, v = 0, v = 1, w = 0, w = 1.
inline constexpr std::array<Quad, 6> kHexFaces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
/// Edges of each face, as indices into `kHexEdges`.
inline constexpr std::array<Quad, 6> kHexFaceEdges{
    {{8, 7, 11, 3}, {1, 10, 5, 9}, {0, 9, 4, 8}, {11, 6, 10, 2}, {3, 2, 1, 0}, {4, 5, 6, 7}}};

/// Nodes of a cell or skin quad, corners first. A hexahedron has 8, 20 or 27, a quad 4, 8 or 9, a wedge 6, a
/// triangle 3.
struct CellNodes {
    std::array<Index, 27> node{};
    std::size_t count = 0;

    [[nodiscard]] const Index* begin() const { return node.data(); }
    [[nodiscard]] const Index* end() const { return node.data() + count; }
    [[nodiscard]] std::span<const Index> all() const& { return std::span(node).first(count); }
    void all() const&& = delete; ///< the span would outlive the nodes
};

/// The middle nodes of a swept mesh of order 2. Their numbers follow from level and layer; nothing is stored
/// for each cell.
///
/// Order of the middle nodes, for each level and the layer above it:
/// 1. on the level: of the sides of the source's quads;
/// 2. on the level, hex27 only: of the quads;
/// 3. in the layer: of the vertical edges over the source's nodes;
/// 4. in the layer, hex27 only: of the vertical faces over the sides of the source's quads;
/// 5. in the layer, hex27 only: of the cells.
struct MiddleNodes {
    bool full = false;           ///< true: hex27; false: hex20
    std::vector<Segment> sides;  ///< sides of the source quads, each once, lower node first
    std::vector<Quad> side_of;   ///< for each quad, the number of the side from corner k to the next
    std::vector<Index> rim_side; ///< for each side in `HexMesh::rim`, its index in `sides`
    std::vector<Vec3> nodes;     ///< [model length]

    /// Whether there are no middle nodes: the mesh is of order 1.
    [[nodiscard]] bool empty() const { return side_of.empty(); }
};

/// Positions in `MiddleNodes::nodes`. Levels are numbered from 0 to the number of layers.
class MiddlePlaces {
public:
    explicit MiddlePlaces(const HexMesh& mesh);
    [[nodiscard]] std::size_t side(std::size_t level, Index side) const
    {
        return level * period_ + index(side);
    }
    /// Position of the middle node of a quad on a level. @pre hex27, as for `face()` and `cell()`
    [[nodiscard]] std::size_t quad(std::size_t level, std::size_t quad) const
    {
        return level * period_ + sides_ + quad;
    }
    [[nodiscard]] std::size_t upright(std::size_t layer, Index node) const
    {
        return layer * period_ + on_level_ + index(node);
    }
    [[nodiscard]] std::size_t face(std::size_t layer, Index side) const
    {
        return layer * period_ + on_level_ + nodes_ + index(side);
    }
    [[nodiscard]] std::size_t cell(std::size_t layer, std::size_t quad) const
    {
        return layer * period_ + on_level_ + nodes_ + sides_ + quad;
    }
    /// Number of all middle nodes.
    [[nodiscard]] std::size_t count() const { return layers_ * period_ + on_level_; }

private:
    std::size_t sides_, nodes_, layers_, on_level_, period_;
};

/// Number the sides of a mesh of order 1. The caller then provides `MiddlePlaces::count()` middle nodes.
/// O(quads).
MiddleNodes number_sides(const HexMesh& mesh, bool full);

/// All nodes of a cell; numbers >= `mesh.nodes.size()` are middle nodes. @pre cell < cell_count()
CellNodes cell_nodes(const HexMesh& mesh, std::size_t cell);
/// All nodes of skin quad `i`, oriented outward: the corners as `skin_quad()`, the middle node of the side
/// after each corner, the centre. @pre i < skin_count()
CellNodes skin_nodes(const HexMesh& mesh, std::size_t i);

/// The 27 nodes of a hex27 for a cell with 8, 20 or 27 nodes. Missing nodes are computed with the shape
/// functions of the hex8 or hex20. @pre 8, 20 or 27 points
std::array<Vec3, 27> as_hex27(std::span<const Vec3> places);

} // namespace lacuna::mesh
