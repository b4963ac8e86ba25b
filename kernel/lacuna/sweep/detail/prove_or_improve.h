// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <optional>
#include <set>
#include <vector>

namespace lacuna::sweep {

/// Prove the mesh; where cells are folded or poor, move nodes and prove it again. What was done goes to the
/// report, and into the finding that is left.
///
/// @param faces  of each patch of the skin.
/// @param kept   faces whose own quads are the mesh: their nodes stay.
/// @param held   of each node, whether it stays; empty: none does for that.
/// @param measured  the quality of the cells as they are; nothing: it is not known.
quality::Proof prove_or_improve(Swept& swept, const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::set<FaceId>& kept, std::vector<char> held,
                                std::optional<quality::Quality> measured, const SweepOptions& options,
                                const RunContext& context);

} // namespace lacuna::sweep
