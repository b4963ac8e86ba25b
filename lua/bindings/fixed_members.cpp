// SPDX-License-Identifier: MIT
#include "bindings/fixed_members.h"

namespace lacuna::lua {

namespace {

/// The assembly gives groups their region's names again.
void forget_region(mesh::HexMesh& mesh, const std::string& region)
{
    mesh.volume_groups = {"volume"};
    if (region.empty()) return;
    for (mesh::SkinPatch& patch : mesh.patches)
        std::erase_if(patch.groups,
                      [&](const std::string& group) { return group.starts_with(region + ":"); });
}

std::unique_ptr<FixedMember> fixed_member(const sweep::Swept& swept, const std::string& region,
                                          const std::string& material, const RunContext& context)
{
    auto member = std::make_unique<FixedMember>();
    member->swept = swept;
    member->region = region;
    member->material = material;
    forget_region(member->swept.mesh, region);
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
        for (std::size_t p = 0; p < whole.regions.size(); ++p)
            members.push_back(
                fixed_member(whole.swept.parts[p], whole.regions[p], whole.materials[p], context));
    }
    return members;
}

} // namespace lacuna::lua
