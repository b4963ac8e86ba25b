// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"

#include <string>
#include <vector>

namespace lacuna::lua {

/// Make the pieces of each full turn one region of its name.
/// @param turn_of  of each part, the region that the whole turn is; empty: it is no piece of one.
void join_turns(AssemblyMeshState& mesh, const std::vector<std::string>& turn_of);

/// Whether a part is the first of its region.
bool begins_region(const AssemblyMeshState& mesh, std::size_t part);

} // namespace lacuna::lua
