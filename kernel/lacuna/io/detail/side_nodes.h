// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/message.h>
#include <lacuna/mesh/shared/mesh_view.h>

#include <array>
#include <span>
#include <string>
#include <vector>

/// Sides of cells as lists of nodes. Internal to this folder.
namespace lacuna::io {

/// The nodes of the sides that are members of the view's sets, for formats whose sets list nodes instead of
/// cells.
class SideNodes {
public:
    /// @note  O(n log n) in the sides, O(n) in the cells
    explicit SideNodes(const mesh::MeshView& view);

    /// The nodes of a side, as indices: its corners, the middles of its edges, and its centre. The corners of
    /// a solid's side are counter-clockwise seen from outside; those of a shell's front or back, seen from
    /// the front or back. Empty for an edge of a shell.
    /// @pre  the side is a member of a set of the view
    [[nodiscard]] std::span<const Index> operator[](const mesh::CellSide& side) const;

    /// Call `visit(nodes)` for each side of a set. Edges of shells are only counted, in a note.
    template <class Visit>
    void each_face(const mesh::MeshView::Set& set, std::vector<std::string>& notes, const Visit& visit) const
    {
        std::size_t edges = 0;
        for (const mesh::CellSide& side : set.sides)
            if (const std::span<const Index> nodes = (*this)[side]; nodes.empty())
                ++edges;
            else
                visit(nodes);
        if (edges > 0)
            notes.push_back(formatted("{} edges of shells in the set {} are not written", edges, set.name));
    }

private:
    struct Nodes {
        std::array<Index, 9> node{};
        std::size_t count = 0;
    };
    static Nodes nodes_of(mesh::CellShape shape, std::span<const Index> cell, int side);

    std::vector<mesh::CellSide> sides_; ///< rising
    std::vector<Nodes> nodes_;          ///< nodes of each of these sides
};

} // namespace lacuna::io
