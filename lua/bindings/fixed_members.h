// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"

#include <lacuna/io/mesh_skin.h>

#include <memory>
#include <string>
#include <vector>

namespace lacuna::lua {

/// A mesh that takes part in an assembly as it is.
struct FixedMember {
    io::MeshSkin skin;
    sweep::Swept swept; ///< of which `faces` are the skin's
    std::string region; ///< empty: the mesh has no name
    std::string material;
    std::string whole;   ///< the volume it is a piece of; empty: it is none
    std::string turn_of; ///< of a piece of a full turn: the region that all of it is
};

/// The parts of the mesh an assembly's entry is, in their order. @pre the entry is a mesh
/// @throw InvalidInput  as `io::skin_of()`.
std::vector<std::unique_ptr<FixedMember>> fixed_members(const AssemblyState::Entry& entry,
                                                        const RunContext& context);

} // namespace lacuna::lua
