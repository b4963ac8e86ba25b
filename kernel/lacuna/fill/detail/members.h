// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/fill.h>

#include <string>
#include <vector>

namespace lacuna::fill {

/// Close a volume and check that it has ends.
/// @param region  its name, for messages.
Volume close_to_sweep(const Volume& volume, const std::string& region, const RunContext& context);

/// A piece of a cut as a volume of its own, with what the whole was told.
Volume piece_of(const Volume& whole, closure::StepPiece piece, const std::string& name);

/// The pieces of one volume, swept as an assembly.
FilledParts sweep_pieces(const Volume& volume, const sweep::SweepOptions& options, const RunContext& context);

/// A line for each face of the file that is missing in a volume, and what stands there.
void report_left_out(const Volume& volume, std::vector<std::string>& report);

} // namespace lacuna::fill
