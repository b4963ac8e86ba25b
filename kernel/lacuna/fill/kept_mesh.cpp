// SPDX-License-Identifier: MIT
#include <lacuna/fill/detail/kept_mesh.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/healing/shared/weld.h>

#include <algorithm>
#include <iterator>
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
                               const std::string& material, bool copied)
{
    auto kept = std::make_unique<KeptMesh>();
    kept->swept = swept;
    kept->region = name;
    kept->material = material;
    kept->copied = copied;
    remove_name(kept->swept.mesh, name);
    kept->swept.report.emplace_back(formatted("kept unchanged: {} cells", swept.mesh.cell_count()));
    return kept;
}

/// If a node of a copy differs from a node of another mesh by rounding only, move it onto that node.
void settle(std::span<KeptMesh* const> meshes, const RunContext& context)
{
    if (std::ranges::none_of(meshes, &KeptMesh::copied)) return;
    std::vector<Vec3> points;
    std::vector<std::pair<KeptMesh*, Index>> nodes;
    for (const bool copied : {false, true}) { // nodes that stay in place come first
        for (KeptMesh* const kept : meshes) {
            const mesh::HexMesh& mesh = kept->swept.mesh;
            if (kept->copied != copied) continue;
            std::vector<bool> seen(mesh.node_count(), false);
            for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
                for (const Index n : mesh::skin_nodes(mesh, i)) {
                    if (seen[index(n)]) continue;
                    seen[index(n)] = true;
                    points.push_back(mesh.node(index(n)));
                    nodes.emplace_back(kept, n);
                }
            }
        }
    }
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    const std::vector<Index> same = healing::weld(points, kSamePlace * box.diagonal().norm(), context);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].first->copied)
            place(nodes[i].first->swept.mesh, nodes[i].second) = points[index(same[i])];
}

} // namespace

std::unique_ptr<KeptMesh> keep(const FilledVolume& mesh)
{
    const std::vector<std::string>& groups = mesh.swept.mesh.volume_groups;
    const bool named = !groups.empty() && groups.front() != "volume";
    auto kept = keep(mesh.swept, named ? groups.front() : "", mesh.material, mesh.copied);
    kept->unit = mesh.unit;
    kept->columns = mesh.columns;
    return kept;
}

std::vector<std::unique_ptr<KeptMesh>> keep(FilledParts mesh)
{
    if (!mesh.tets.empty())
        throw InvalidInput(
            Message("fill.mixed_member", "a mesh with tetrahedra cannot be a member of an assembly")
                .remedy("give its volumes instead, with fallback = \"mixed\""));
    if (!mesh.interfaces.empty())
        throw InvalidInput(
            Message("fill.split_member", "a mesh that was split cannot be a member of an assembly")
                .remedy("join the meshes first, and split the joined one"));
    if (!mesh.contacts.empty())
        throw InvalidInput(
            Message("fill.contact_member", "a mesh with contact pairs cannot be a member of an assembly")
                .remedy("give its volumes instead"));
    hold_nodes(mesh);
    std::vector<std::unique_ptr<KeptMesh>> all;
    for (std::size_t p = 0; p < mesh.regions.size(); ++p) {
        const std::string& group = mesh.swept.parts[p].mesh.volume_groups.front();
        KeptMesh& kept = *all.emplace_back(keep(mesh.swept.parts[p], group, mesh.materials[p], mesh.copied));
        kept.region = mesh.regions[p];
        kept.unit = mesh.unit;
        std::ranges::copy_if(mesh.columns, std::back_inserter(kept.columns),
                             [&](const io::ColumnSet& columns) { return columns.part == p; });
        if (group != "volume") kept.whole = group;
        if (std::ranges::count(mesh.regions, mesh.regions[p]) == 1) continue;
        kept.turn_of = mesh.regions[p];
        kept.region += formatted("_{}", p + 1);
    }
    return all;
}

void add_skins(std::span<KeptMesh* const> meshes, const RunContext& context)
{
    settle(meshes, context);
    for (KeptMesh* const kept : meshes) {
        kept->skin = io::skin_of(kept->swept.mesh, context);
        kept->swept.faces = kept->skin.face;
    }
}

} // namespace lacuna::fill
