// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/error.h>
#include <lacuna/quality/quality.h>
#include <lacuna/sweep/sweep.h>

#include <set>
#include <vector>

namespace lacuna::sweep {

/// What moving nodes can mend: cells that are folded, not certified or below the limit.
bool is_poor(const NotSweepable& error);

/// Prove the mesh; where cells are folded or poor, move nodes and prove it again. What was done goes to the report.
///
/// @param faces  of each patch of the skin.
/// @param kept   faces whose own quads are the mesh: their nodes stay.
/// @throw NotSweepable  what `quality::prove()` says, with what was tried.
quality::Quality prove_or_improve(Swept& swept, const topology::Model& model,
                                  const std::vector<FaceId>& faces, const std::set<FaceId>& kept,
                                  const SweepOptions& options, const RunContext& context);

} // namespace lacuna::sweep
