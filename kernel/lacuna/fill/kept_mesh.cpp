// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/kept_mesh.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <utility>

namespace lacuna::fill {

namespace {

/// Remove a member's name from its group names: the assembly prefixes it again.
void remove_name(mesh::HexMesh& mesh, const std::string& name)
{
    const std::string before = name + ":";
    for (mesh::SkinPatch& patch : mesh.patches) {
        std::vector<std::string> groups;
        for (std::string& group : patch.groups) {
            if (group.starts_with(before)) group.erase(0, before.size());
            if (std::ranges::find(groups, group) == groups.end()) groups.push_back(std::move(group));
        }
        patch.groups = std::move(groups);
    }
}

std::unique_ptr<KeptMesh> keep(const sweep::Swept& swept, const std::string& name,
                               const std::string& material, const RunContext& context)
{
    auto kept = std::make_unique<KeptMesh>();
    kept->swept = swept;
    kept->region = name;
    kept->material = material;
    remove_name(kept->swept.mesh, name);
    kept->skin = io::skin_of(kept->swept.mesh, context);
    kept->swept.faces = kept->skin.face;
    kept->swept.report.emplace_back(formatted("kept as it came: {} cells", swept.mesh.cell_count()));
    return kept;
}

} // namespace

std::unique_ptr<KeptMesh> keep(const FilledVolume& mesh, const RunContext& context)
{
    const std::vector<std::string>& groups = mesh.swept.mesh.volume_groups;
    const bool named = !groups.empty() && groups.front() != "volume";
    auto kept = keep(mesh.swept, named ? groups.front() : "", mesh.material, context);
    kept->unit = mesh.unit;
    return kept;
}

std::vector<std::unique_ptr<KeptMesh>> keep(const FilledParts& mesh, const RunContext& context)
{
    if (!mesh.tets.empty())
        throw InvalidInput(
            Message("fill.mixed_member", "a mesh with tetrahedra cannot be a member of an assembly")
                .remedy("give its volumes instead, with fallback = \"mixed\""));
    if (!mesh.interfaces.empty())
        throw InvalidInput(
            Message("fill.split_member", "a mesh that was split cannot be a member of an assembly")
                .remedy("join the meshes first, and split the joined one"));
    std::vector<std::unique_ptr<KeptMesh>> all;
    for (std::size_t p = 0; p < mesh.regions.size(); ++p) {
        const std::string& group = mesh.swept.parts[p].mesh.volume_groups.front();
        KeptMesh& kept = *all.emplace_back(keep(mesh.swept.parts[p], group, mesh.materials[p], context));
        kept.region = mesh.regions[p];
        kept.unit = mesh.unit;
        if (group != "volume") kept.whole = group;
        if (std::ranges::count(mesh.regions, mesh.regions[p]) == 1) continue;
        kept.turn_of = mesh.regions[p];
        kept.region += formatted("_{}", p + 1);
    }
    return all;
}

} // namespace lacuna::fill
