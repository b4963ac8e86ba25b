// SPDX-License-Identifier: MIT
#include "bindings/full_turns.h"

#include <lacuna/core/error.h>

#include <algorithm>
#include <map>
#include <optional>

namespace lacuna::lua {

namespace {

/// What all pieces of a turn come to.
std::map<std::string, sweep::Fidelity> whole_turns(const sweep::SweptAssembly& swept,
                                                   const std::vector<std::string>& turn_of)
{
    std::map<std::string, sweep::Fidelity> whole;
    for (std::size_t p = 0; p < swept.parts.size(); ++p) {
        const std::string& turn = turn_of[swept.member[p]];
        if (turn.empty()) continue;
        whole[turn].volume += swept.parts[p].fidelity.volume;
        whole[turn].sealed_volume += swept.parts[p].fidelity.sealed_volume;
    }
    return whole;
}

} // namespace

sweep::SweptAssembly sweep_turns(std::vector<sweep::AssemblyMember>& members,
                                 const std::vector<std::string>& turn_of, const RunContext& context)
{
    sweep::SweptAssembly best = sweep::sweep_assembly(members, context);
    for (bool refined = true; refined;) {
        refined = false;
        const std::map<std::string, sweep::Fidelity> before = whole_turns(best, turn_of);
        std::vector<sweep::AssemblyMember> next = members;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const auto whole = before.find(turn_of[m]);
            if (turn_of[m].empty() || whole == before.end()) continue;
            if (const auto sides = sweep::sides_for_lost_volume(whole->second, members[m].options)) {
                next[m].options.curvature = *sides;
                refined = true;
            }
        }
        if (!refined) break;
        try {
            sweep::SweptAssembly again = sweep::sweep_assembly(next, context);
            const std::map<std::string, sweep::Fidelity> after = whole_turns(again, turn_of);
            const bool closer = std::ranges::any_of(after, [&](const auto& turn) {
                const auto was = before.find(turn.first);
                return was != before.end() && sweep::is_closer(turn.second, was->second);
            });
            if (!closer) break;
            best = std::move(again);
            members = std::move(next);
        } catch (const NotSweepable& error) {
            log_line(context, std::string("more sides for a full turn: ") + error.what());
            break;
        }
    }
    return best;
}

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
