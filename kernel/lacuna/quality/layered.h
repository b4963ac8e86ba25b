// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/quality.h>

namespace lacuna::quality {

/// `measure()` of a mesh whose nodes are made when they are asked for: each layer once, some layers at a
/// time. Sums may differ from those of `measure()` in the last digits. Memory does not depend on the layers.
/// @throw Cancelled
Quality measure(const mesh::LayeredMesh& layered, const RunContext& context = {});

/// `prove()` of such a mesh: the same checks.
///
/// Nodes in one place are sought among layers next to each other, and, where boxes of layers further apart
/// meet, as those of a sharp bend do, among the nodes in both boxes: layers are made anew for each share of
/// these that has room at once.
/// @param measured  measure() of it
/// @throw Cancelled
Proof prove(const mesh::LayeredMesh& layered, Quality measured, double min_scaled_jacobian = 0,
            const RunContext& context = {});

} // namespace lacuna::quality
