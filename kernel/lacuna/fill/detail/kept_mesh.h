// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/filled.h>
#include <lacuna/io/shared/mesh_skin.h>

#include <memory>
#include <string>
#include <vector>

namespace lacuna::fill {

/// A mesh that is a member of an assembly as it is.
struct KeptMesh {
    io::MeshSkin skin;
    sweep::Swept swept; ///< of which `faces` are the skin's
    std::string region; ///< empty: the mesh has no name
    std::string material;
    std::string whole;   ///< the volume it is a piece of; empty: it is none
    std::string turn_of; ///< of a piece of a full turn: the region of the whole turn
};

/// @throw InvalidInput  as `io::skin_of()`.
std::unique_ptr<KeptMesh> keep(const FilledVolume& mesh, const RunContext& context);
/// Its parts, in their order.
std::vector<std::unique_ptr<KeptMesh>> keep(const FilledParts& mesh, const RunContext& context);

} // namespace lacuna::fill
