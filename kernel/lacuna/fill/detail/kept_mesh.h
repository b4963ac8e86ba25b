// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/fill/filled.h>
#include <lacuna/io/shared/mesh_skin.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace lacuna::fill {

/// Coordinates of a corner node or a middle node.
inline Vec3& place(mesh::HexMesh& mesh, Index node)
{
    const std::size_t n = index(node), corners = mesh.nodes.size();
    return n < corners ? mesh.nodes[n] : mesh.middles.nodes[n - corners];
}

/// A finished mesh that joins an assembly unchanged.
struct KeptMesh {
    io::MeshSkin skin;  ///< made by add_skins()
    sweep::Swept swept; ///< its `faces` are faces of `skin`
    std::string region; ///< empty: the mesh has no name
    std::string material;
    std::string unit;
    std::string whole;   ///< name of the volume that this mesh is a piece of; empty if it is not a piece
    bool copied = false; ///< as in `FilledVolume`
    std::vector<io::ColumnSet> columns{}; ///< as in `FilledVolume`
    std::string turn_of;                  ///< for a piece of a full turn: region of the whole turn
};

std::unique_ptr<KeptMesh> keep(const FilledVolume& mesh);
/// Keep each part of a mesh, in the order of the parts.
/// @throw InvalidInput "fill.mixed_member"  the mesh has tetrahedra; "fill.split_member"  it was split by
///         `split_interface()`; "fill.contact_member"  it has contact pairs.
std::vector<std::unique_ptr<KeptMesh>> keep(FilledParts mesh);

/// If a node of a copy differs from a node of another mesh by rounding only, move it onto that node. Then
/// make the skins of all meshes.
/// @throw InvalidInput  the errors of `io::skin_of()`.
void add_skins(std::span<KeptMesh* const> meshes, const RunContext& context);

} // namespace lacuna::fill
