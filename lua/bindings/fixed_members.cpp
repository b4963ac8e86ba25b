// SPDX-License-Identifier: MIT
#include "bindings/fixed_members.h"

#include <algorithm>

namespace lacuna::lua {

namespace {

/// The assembly puts a member's name before its groups again.
void forget_name(mesh::HexMesh& mesh, const std::string& name)
{
    const std::string before = name + ":";
    const auto forget = [&](std::string& group) {
        if (group.starts_with(before)) group.erase(0, before.size());
    };
    for (mesh::SkinPatch& patch : mesh.patches) {
        std::vector<std::string> groups;
        for (std::string& group : patch.groups) {
            forget(group);
            if (std::ranges::find(groups, group) == groups.end()) groups.push_back(std::move(group));
        }
        patch.groups = std::move(groups);
    }
}

std::unique_ptr<FixedMember> fixed_member(const sweep::Swept& swept, const std::string& name,
                                          const std::string& material, const RunContext& context)
{
    auto member = std::make_unique<FixedMember>();
    member->swept = swept;
    member->region = name;
    member->material = material;
    forget_name(member->swept.mesh, name);
    member->skin = io::skin_of(member->swept.mesh, context);
    member->swept.faces = member->skin.face;
    member->swept.report.emplace_back("kept as it came: " + std::to_string(swept.mesh.cell_count()) +
                                      " cells");
    return member;
}

} // namespace

std::vector<std::unique_ptr<FixedMember>> fixed_members(const AssemblyState::Entry& entry,
                                                        const RunContext& context)
{
    std::vector<std::unique_ptr<FixedMember>> members;
    if (entry.mesh) {
        const std::vector<std::string>& groups = entry.mesh->swept.mesh.volume_groups;
        const bool named = !groups.empty() && groups.front() != "volume";
        members.push_back(
            fixed_member(entry.mesh->swept, named ? groups.front() : "", entry.mesh->material, context));
    }
    if (entry.meshes) {
        const AssemblyMeshState& whole = *entry.meshes;
        for (std::size_t p = 0; p < whole.regions.size(); ++p) {
            const std::string& group = whole.swept.parts[p].mesh.volume_groups.front();
            members.push_back(fixed_member(whole.swept.parts[p], group, whole.materials[p], context));
            FixedMember& member = *members.back();
            member.region = whole.regions[p];
            if (group != "volume") member.whole = group;
            if (std::ranges::count(whole.regions, whole.regions[p]) == 1) continue;
            member.turn_of = whole.regions[p];
            member.region += "_" + std::to_string(p + 1);
        }
    }
    return members;
}

} // namespace lacuna::lua
