// SPDX-License-Identifier: MIT
#include "bindings/full_turns.h"

#include <algorithm>

namespace lacuna::lua {

void join_turns(AssemblyMeshState& mesh, const std::vector<std::string>& turn_of)
{
    for (std::size_t p = 0; p < turn_of.size(); ++p)
        if (!turn_of[p].empty()) mesh.regions[p] = turn_of[p];
}

bool begins_region(const AssemblyMeshState& mesh, std::size_t part)
{
    return std::find(mesh.regions.begin(), mesh.regions.end(), mesh.regions[part]) ==
           mesh.regions.begin() + static_cast<std::ptrdiff_t>(part);
}

} // namespace lacuna::lua
