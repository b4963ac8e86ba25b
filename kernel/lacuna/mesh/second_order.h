// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lacuna::mesh {

struct HexMesh;

/// Nodes of a hexahedron of order 2, in the order of VTK, which is Abaqus's too: the corners as
/// in `Hex`, the middles of the sides in the order of `kHexEdges`, those of the faces in the order of
/// `kHexFaces`, that of the whole. A hex20 has the first twenty, a hex27 all.
///
/// Corners of each of the twelve sides.
inline constexpr std::array<Segment, 12> kHexEdges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
/// Corners of each of the six faces: u least and most, v, w.
inline constexpr std::array<Quad, 6> kHexFaces{
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};
/// Sides of each face, by their numbers in `kHexEdges`.
inline constexpr std::array<Quad, 6> kHexFaceEdges{
    {{8, 7, 11, 3}, {1, 10, 5, 9}, {0, 9, 4, 8}, {11, 6, 10, 2}, {3, 2, 1, 0}, {4, 5, 6, 7}}};

/// Nodes of a cell or of a quad of the skin, corners first: 8, 20 or 27, and 4, 8 or 9; of a wedge 6, of a
/// triangle 3.
struct CellNodes {
    std::array<Index, 27> node{};
    std::size_t count = 0;

    [[nodiscard]] std::span<const Index> all() const { return std::span(node).first(count); }
};

/// The middle nodes of a swept mesh of order 2. Their numbers follow from level and layer; nothing is stored
/// for a cell.
///
/// Level after level lie the middles of the source's sides on it and, of hex27, those of the quads; then,
/// before the next level, those of the upright sides over the source's nodes and, of hex27, those of the
/// faces over the sides and of the cells.
struct MiddleNodes {
    bool full = false;           ///< hex27; else hex20
    std::vector<Segment> sides;  ///< of the source quads, each once, the lower node first
    std::vector<Quad> side_of;   ///< side k of each quad, from its corner k to the next
    std::vector<Index> rim_side; ///< of each side of `HexMesh::rim`
    std::vector<Vec3> nodes;     ///< [model length]

    /// Whether none are numbered: the mesh is of order 1.
    [[nodiscard]] bool empty() const { return side_of.empty(); }
};

/// Places in `MiddleNodes::nodes`. Levels count from 0 to the number of layers.
class MiddlePlaces {
public:
    explicit MiddlePlaces(const HexMesh& mesh);
    [[nodiscard]] std::size_t side(std::size_t level, Index side) const
    {
        return level * period_ + index(side);
    }
    /// Of the middle of a quad on a level. @pre hex27, as for the two below
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
    /// Of all middle nodes.
    [[nodiscard]] std::size_t count() const { return layers_ * period_ + on_level_; }

private:
    std::size_t sides_, nodes_, layers_, on_level_, period_;
};

/// Number the sides of a mesh of order 1; its middle nodes are to be placed by the caller, who gives them
/// `MiddlePlaces::count()` places. O(quads).
MiddleNodes number_sides(const HexMesh& mesh, bool full);

/// All nodes of a cell; numbers from `mesh.nodes.size()` on are middle nodes. @pre cell < cell_count()
CellNodes cell_nodes(const HexMesh& mesh, std::size_t cell);
/// All nodes of skin quad `i`, outward: the corners of `skin_quad()`, the middle of the side from each, the
/// centre. @pre i < skin_count()
CellNodes skin_nodes(const HexMesh& mesh, std::size_t i);

/// Places of the nodes of a cell as those of a hex27: what a hex20 leaves out follows from its nodes, as its
/// shape functions say, and of a hex8 all that is in the middle. @pre 8, 20 or 27 places
std::array<Vec3, 27> as_hex27(std::span<const Vec3> places);

} // namespace lacuna::mesh
