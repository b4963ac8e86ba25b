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

/// A node that is not finite, or two that lie in one place. Parallel.
Found check_nodes(std::span<const Vec3> nodes, Index nodes_per_layer, const RunContext& context);

/// Cells that are not certified or below the limit; names the worst.
Found check_quality(const Quality& quality, double min_scaled_jacobian, int layers);

/// "node 12 (layer 2 of 9, at x y z)"; people count from 1. `nodes_per_layer` 0: no layers.
std::string node_name(std::span<const Vec3> nodes, Index node, Index nodes_per_layer);

} // namespace lacuna::quality
