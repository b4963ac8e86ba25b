// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Whether a side branch leaves a wall of the volume: a closed line of concave edges between walls parts the
/// skin into one side that has two ends, named or missing, and another that has an end too, or is deeper than
/// half as wide.
bool has_branches(const topology::OpenVolume& volume, const RunContext& context = {});

/// Cut a volume at its side branches into arms that can be swept: a tee into three, a manifold into two more
/// a branch and one more between two of them.
///
/// Where a branch joins, three void faces meet in one line across its mouth that dips into the main body: one
/// across the main body, and two from that line to either half of the mouth. Each arm ends in two of them.
/// So the junction of a tee of equal tubes is that of three half ellipses. What is left is cut on, and so are
/// branches of branches. Where branches leave to several sides, or one leaves an arm across the line in its
/// end, the main body's walls are split first by planes along it through the middle of each mouth: these
/// lines say what goes with what on rims that are bent at mouths.
/// @return  pieces in the order of the cuts; the volume itself where it has no branches.
/// @throw NotSweepable "closure.branches"  a main body whose walls are missing at the mouth, or of more than
///         two ends; mouths side by side; where it could be cut by hand is named. A branch that reaches
///         beyond the side of the main body. Else as `cut_by_plane()`.
/// @note  O(branches · facets log facets).
std::vector<StepPiece> cut_branches(const topology::OpenVolume& volume, const RunContext& context = {});

/// Whether a volume has to be cut to be swept, by its branches or steps, or as it runs round its whole turn.
bool has_pieces(const topology::OpenVolume& volume, const RunContext& context = {});
/// The pieces of a volume with branches or steps, or both, or of a full turn; itself where it has none.
std::vector<StepPiece> cut_into_pieces(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
