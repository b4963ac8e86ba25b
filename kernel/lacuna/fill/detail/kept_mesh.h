// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/filled.h>
#include <lacuna/io/shared/mesh_skin.h>

#include <memory>
#include <string>
#include <vector>

namespace lacuna::fill {

/// A finished mesh that joins an assembly unchanged.
struct KeptMesh {
    io::MeshSkin skin;
    sweep::Swept swept; ///< its `faces` are those of the skin
    std::string region; ///< empty: the mesh has no name
    std::string material;
    std::string unit;
    std::string whole;   ///< volume that this mesh is a piece of; empty: the mesh is no piece
    std::string turn_of; ///< for a piece of a full turn: region of the whole turn
};

/// @throw InvalidInput  as `io::skin_of()`.
std::unique_ptr<KeptMesh> keep(const FilledVolume& mesh, const RunContext& context);
/// As above for each part, in the order of the parts.
/// @throw InvalidInput "fill.mixed_member"  the mesh has tetrahedra.
std::vector<std::unique_ptr<KeptMesh>> keep(const FilledParts& mesh, const RunContext& context);

} // namespace lacuna::fill
