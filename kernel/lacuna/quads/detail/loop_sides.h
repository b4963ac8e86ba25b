// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/partial_mesh.h>

#include <vector>

namespace lacuna::quads::paving {

/// The sides of a loop, with a bounding box for each group of consecutive sides. With these boxes, the class
/// tests quickly whether a line crosses a side.
class LoopSides {
public:
    /// @pre the mesh and the loop outlive this object; points may be added to the mesh.
    LoopSides(const PartialMesh& partial, const Cycle& loop);

    /// Whether the segment between two nodes, without its ends, meets no side.
    [[nodiscard]] bool is_clear(Index a, Index b) const;

    [[nodiscard]] const Eigen::AlignedBox2d& box() const { return whole_; }
    /// A lower bound of the distance between two loops: the least distance of their groups of sides.
    [[nodiscard]] double gap(const LoopSides& other) const;

private:
    [[nodiscard]] bool passes(Index a, Index b, Index c, Index d) const;

    const PartialMesh& partial_;
    const Cycle& loop_;
    Eigen::AlignedBox2d whole_;
    std::vector<Eigen::AlignedBox2d> runs_;
};

} // namespace lacuna::quads::paving
