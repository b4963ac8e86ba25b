// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>

#include <optional>
#include <span>
#include <string>

/// What the proofs of swept meshes and of lists of cells share. Internal to this folder.
namespace lacuna::quality {

/// What a check found: nothing where all is well.
using Found = std::optional<Finding>;

/// What is wrong with the arrays of a swept mesh whatever its nodes are: sizes, patches, quads that do not
/// conform, skin that is open.
/// @param nodes  as many as the mesh holds
Found check_arrays(const mesh::HexMesh& mesh, std::size_t nodes);

/// A node that is not finite, or two that lie in one place. Parallel.
Found check_nodes(std::span<const Vec3> nodes, Index nodes_per_layer, const RunContext& context);

/// Cells that are not certified or below the limit; names the worst.
Found check_quality(const Quality& quality, double min_scaled_jacobian, int layers);

/// "node 12 (layer 2 of 9, at x y z)"; people count from 1. `nodes_per_layer` 0: no layers.
std::string node_name(std::span<const Vec3> nodes, Index node, Index nodes_per_layer);
std::string node_name(const Vec3& at, Index node, Index nodes_per_layer, std::size_t levels);
/// Of nodes by their names.
Finding not_finite(const std::string& node);
Finding coincident_nodes(const std::string& a, const std::string& b);

} // namespace lacuna::quality
