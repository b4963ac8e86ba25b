// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>

#include <optional>
#include <span>
#include <string>

/// Checks shared by the proofs of swept meshes and of lists of cells. Internal to this folder.
namespace lacuna::quality {

/// The fault that a check found, if any.
using Found = std::optional<Finding>;

/// Check the arrays of a swept mesh, independent of coordinates: sizes, patches, conforming quads, closed
/// skin.
/// @param nodes  number of nodes that the mesh must have
Found check_arrays(const mesh::HexMesh& mesh, std::size_t nodes);

/// Check for nodes that are not finite, and for coincident nodes. Parallel.
Found check_nodes(std::span<const Vec3> nodes, Index nodes_per_layer, const RunContext& context);

/// Check for cells that are not certified, or below the limit; the finding names the worst cells.
Found check_quality(const Quality& quality, double min_scaled_jacobian, int layers);

/// The first node that is not finite. @pre  there is one
Index first_not_finite(std::span<const Vec3> nodes);

/// Number and place of a node for messages, in which numbers start at 1.
struct NodeName {
    NamedEntity node;
    std::string place; ///< "level 2 of 9, at x y z"
};

/// @param nodes_per_layer  0: no levels.
NodeName node_name(std::span<const Vec3> nodes, Index node, Index nodes_per_layer);
NodeName node_name(const Vec3& at, Index node, Index nodes_per_layer, std::size_t levels);
Finding not_finite(const NodeName& node);
Finding coincident_nodes(const NodeName& a, const NodeName& b);

} // namespace lacuna::quality
