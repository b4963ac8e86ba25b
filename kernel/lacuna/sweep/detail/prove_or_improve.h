// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quality/quality.h>
#include <lacuna/sweep/improve.h>
#include <lacuna/sweep/sweep.h>

#include <set>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Prove the mesh. If cells are folded or poor, move nodes and prove it again. The attempts are added to the
/// report and, if cells stay bad, to the finding.
///
/// @param faces  face of each patch of the skin.
/// @param kept   faces whose own quads are kept: their nodes are fixed.
/// @param held   for each node, whether it is fixed; empty: none is.
quality::Proof prove_or_improve(Swept& swept, const topology::Model& model, const std::vector<FaceId>& faces,
                                const std::set<FaceId>& kept, std::vector<char> held,
                                const SweepOptions& options, const RunContext& context);

/// The result of an improvement as a line of the report.
std::string in_words(const Improved& improved);

} // namespace lacuna::sweep
