// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"

#include <lacuna/core/run_context.h>
#include <lacuna/sweep/assembly.h>

#include <string>
#include <vector>

namespace lacuna::lua {

/// Sweep members of which some are pieces of full turns. Where the pieces of one lack more of their volume
/// than a plain sweep may, all is swept anew with more sides for a turn of these, as a plain sweep is.
/// @param turn_of  of each member, the region that the whole turn is; empty: it is no piece of one.
sweep::SweptAssembly sweep_turns(std::vector<sweep::AssemblyMember>& members,
                                 const std::vector<std::string>& turn_of, const RunContext& context);

/// Make the pieces of each full turn one region: they have its name, and what lies between them no groups.
/// @param turn_of  of each part
void join_turns(AssemblyMeshState& mesh, const std::vector<std::string>& turn_of);

/// Whether a part is the first of its region.
bool begins_region(const AssemblyMeshState& mesh, std::size_t part);

} // namespace lacuna::lua
