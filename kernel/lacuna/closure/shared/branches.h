// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// A direction counts as parallel to a body's axis if the sine of the angle between them is below this (6°).
/// For a branch that leaves the body at a smaller angle, the line where the cuts meet is not well defined.
inline constexpr double kAlongAxis = 0.1;

/// Whether a volume has a side branch. Mouth of a branch: a closed line of concave edges between walls that
/// separates the skin into the main body and the branch. The main body has two ends, given or missing. The
/// branch has an end, or is deeper than half the radius of its mouth.
bool has_branches(const topology::OpenVolume& volume, const RunContext& context = {});

/// Cut a volume at its side branches into arms that can be swept: a tee is cut into three arms. A manifold
/// with n branches is cut into 2n + 1 arms, because each branch also cuts the main body in two.
///
/// Three void faces meet in a line that crosses the mouth of a branch and dips into the main body: one face
/// runs across the main body, two run from the line to the halves of the mouth. Each arm ends at two of these
/// faces, so the junction of a tee of equal tubes consists of three half ellipses. The remaining pieces are
/// cut again, and so are branches of branches.
///
/// If branches leave to several sides, or at an angle to an edge that crosses an end of the main body, the
/// walls of the main body are first split by planes along its axis. One plane runs through the centre of each
/// mouth and of each such edge. Arms have ends that are bent along the mouths; the new edges determine which
/// points of two such ends correspond.
/// @return  pieces in the order of the cuts; the volume itself if it has no branches.
/// @throw NotSweepable "closure.branches"  the main body has missing walls at a mouth, or more than two ends;
///         mouths are adjacent (the remedy names where to cut); or a branch reaches beyond the side of the
///         main body, so that an end of the branch lies next to the mouth. Or the errors of `cut_by_plane()`.
/// @note  O(branches · facets log facets).
std::vector<StepPiece> cut_branches(const topology::OpenVolume& volume, const RunContext& context = {});

/// Whether a volume must be cut to be swept: it has branches or steps, or is a full turn.
bool has_pieces(const topology::OpenVolume& volume, const RunContext& context = {});
/// The pieces of a volume with branches, steps or both, or of a full turn; the volume itself if it has none.
std::vector<StepPiece> cut_into_pieces(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::closure
