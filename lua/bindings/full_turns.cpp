// SPDX-License-Identifier: MIT
#include "bindings/full_turns.h"

#include <algorithm>

namespace lacuna::lua {

void join_turns(AssemblyMeshState& mesh, const std::vector<std::string>& turn_of)
{
    for (std::size_t p = 0; p < turn_of.size(); ++p) {
        if (turn_of[p].empty()) continue;
        const std::string own = mesh.regions[p] + ":", whole = turn_of[p] + ":";
        mesh::HexMesh& part = mesh.swept.parts[p].mesh;
        std::ranges::replace(part.volume_groups, mesh.regions[p], turn_of[p]);
        for (mesh::SkinPatch& patch : part.patches) {
            for (std::string& group : patch.groups)
                if (group.starts_with(own)) group = whole + group.substr(own.size());
        }
        mesh.regions[p] = turn_of[p];
    }
    for (const sweep::SharedFace& face : mesh.swept.shared) {
        if (turn_of[face.a].empty() || turn_of[face.a] != turn_of[face.b]) continue;
        for (const auto& [p, id] : {std::pair(face.a, face.face_a), std::pair(face.b, face.face_b)}) {
            sweep::Swept& part = mesh.swept.parts[p];
            for (std::size_t patch = 0; patch < part.faces.size(); ++patch)
                if (part.faces[patch] == id) part.mesh.patches[patch].groups.clear();
        }
    }
}

bool begins_region(const AssemblyMeshState& mesh, std::size_t part)
{
    return std::find(mesh.regions.begin(), mesh.regions.end(), mesh.regions[part]) ==
           mesh.regions.begin() + static_cast<std::ptrdiff_t>(part);
}

} // namespace lacuna::lua
