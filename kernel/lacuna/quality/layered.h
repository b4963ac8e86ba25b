// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/core/team.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/quality/quality.h>

#include <optional>

namespace lacuna::quality {

/// `measure()` of a mesh whose nodes are made when they are asked for: each layer once, some layers at a
/// time. Sums may differ from those of `measure()` in the last digits. Memory does not depend on the layers.
/// A team shares the layers; what is found is the same for any number, and each of the team gets it.
/// @throw Cancelled; TeamFailed
Quality measure(const mesh::LayeredMesh& layered, const RunContext& context = {}, const Team* team = nullptr);

/// A node of such a mesh that is not finite, or two in one place; shared by a team as `measure()`.
///
/// Nodes in one place are sought among layers next to each other, and, where boxes of layers further apart
/// meet, as those of a sharp bend do, among the nodes in both boxes: layers are made anew for each share of
/// these that has room at once.
/// @throw Cancelled; TeamFailed
std::optional<Finding> find_misplaced(const mesh::LayeredMesh& layered, const RunContext& context = {},
                                      const Team* team = nullptr);

/// `prove()` of such a mesh: the same checks.
/// @param measured   measure() of it
/// @param misplaced  find_misplaced() in it
Proof prove(const mesh::LayeredMesh& layered, Quality measured, std::optional<Finding> misplaced,
            double min_scaled_jacobian = 0);

/// `prove()` of a mesh whose cells were measured since its nodes last moved: they are not measured again.
/// @param measured  what `measure()` found; nothing: they are measured.
Proof prove(const mesh::HexMesh& mesh, std::optional<Quality> measured, double min_scaled_jacobian,
            const RunContext& context = {});

} // namespace lacuna::quality
