// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/mesh/shared/mesh_view.h>

#include <span>
#include <string>
#include <vector>

/// Nodes of periodic faces in files. Internal to this folder.
namespace lacuna::io {

/// Add pairs of nodes to a view, with a set for each side: "periodic_1_a", "periodic_1_b" …, whose members
/// are in the order of the pairs.
/// @param sets  whether the format has sets of nodes; otherwise lists are added
void add_periodic(std::span<const mesh::PeriodicNodes> pairs, bool sets, mesh::MeshView& view);

/// A displacement in an equation.
struct PeriodicTerm {
    std::size_t node = 0; ///< index of a point; from the number of points on, of a reference
    int direction = 0;    ///< 0, 1, 2
    double factor = 0;
};
/// Linear equations between displacements: in each, the terms sum up to zero. The first term of each depends
/// on the others, and no other equation has it first.
struct PeriodicEquations {
    /// For each translation a reference node, whose displacement is the difference of those on its two
    /// sides; here the vector of the translation. Zero for rotations, which have none.
    std::vector<Vec3> references;
    std::vector<std::size_t>
        number; ///< of each reference among all that equations have; `kNoIndex`: it has none
    std::vector<std::vector<PeriodicTerm>> equations;
};
/// The equations of all pairs: each node depends once, on the first node of those that motions take to it.
PeriodicEquations periodic_equations(const mesh::MeshView& view);

/// A sector of a whole: its only pair is a rotation by a whole fraction of a turn, without nodes on the axis.
struct CyclicSector {
    int sectors = 0; ///< of a full turn; 0: it is none
    Vec3 point = Vec3::Zero(), axis = Vec3::UnitZ();
};
CyclicSector cyclic_sector(const mesh::MeshView& view);

} // namespace lacuna::io
