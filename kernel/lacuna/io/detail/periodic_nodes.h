// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/shared/mesh_view.h>

#include <span>
#include <string>
#include <vector>

/// Nodes of periodic faces in files. Internal to this folder.
namespace lacuna::io {

/// Add pairs of periodic nodes to a view, with a set of nodes for each side: "periodic_1_a", "periodic_1_b"
/// …. The members of a set are in the order of the pairs.
/// @param sets  whether the format has sets of nodes; otherwise the view gets lists instead
void add_periodic(std::span<const mesh::PeriodicNodes> pairs, bool sets, mesh::MeshView& view);

/// A term of an equation: a displacement times a factor.
struct PeriodicTerm {
    std::size_t node = 0; ///< index of a point; beyond the number of points, a reference node
    int direction = 0;    ///< 0, 1, 2
    double factor = 0;
    std::int64_t tag = 0; ///< number of the node
};
/// Linear equations between displacements: the terms of each equation sum up to zero. The first term of an
/// equation depends on the others, and is the first term of no other equation.
struct PeriodicEquations {
    /// For each translation, its vector. A reference node represents the translation in equations: the
    /// displacement of this node is the difference between the displacements of the two sides. Rotations have
    /// no reference.
    std::vector<Vec3> references;
    std::vector<std::size_t>
        number; ///< number of the reference of each periodic pair; `kNoIndex`: it has none
    std::vector<std::vector<PeriodicTerm>> equations;
    std::int64_t first = 0; ///< number of the first reference node, above those of all points
    /// The number of the reference node of a pair. @pre it has one
    [[nodiscard]] std::int64_t tag(std::size_t pair) const
    {
        return first + static_cast<std::int64_t>(number[pair]);
    }
};
/// The equations of all pairs. Nodes that are mapped to each other form chains, and each node of a chain
/// depends on the chain's first node.
PeriodicEquations periodic_equations(const mesh::MeshView& view);

/// A mesh as a sector of a rotationally symmetric whole: the only periodic pair of the mesh is a rotation by
/// a whole fraction of a turn, and no node is on the axis.
struct CyclicSector {
    int sectors = 0; ///< number of sectors in a full turn; 0: the mesh is no such sector
    Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ();
};
CyclicSector cyclic_sector(const mesh::MeshView& view);

} // namespace lacuna::io
