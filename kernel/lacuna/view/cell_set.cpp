// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/cell_set.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/core/shared/renumbered.h>
#include <lacuna/mesh/tet_mesh.h>
#include <lacuna/quality/shared/metrics.h>
#include <lacuna/quality/shared/second_order.h>

#include <lacuna/topology/shared/skin_groups.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

namespace lacuna::view {

std::string counted(std::size_t count, const std::string& what)
{
    return formatted("{} {}{}", count, what, count == 1 ? "" : what.ends_with('x') ? "es" : "s");
}

std::vector<ShownPatch> shown_patches(const mesh::HexMesh& mesh)
{
    std::vector<ShownPatch> shown;
    for (const mesh::SkinPatch& patch : mesh.patches) {
        const bool named_void = std::ranges::any_of(patch.groups, topology::is_void_group);
        shown.push_back({patch.tag, patch.groups, patch.face == 0 && named_void, 0});
    }
    for (const std::vector<Index>* list : {&mesh.source_patch, &mesh.target_patch, &mesh.wall_patch})
        for (const Index patch : *list)
            if (patch >= 0) ++shown[index(patch)].quads;
    return shown;
}

namespace {

/// Scaled Jacobian of the cells.
std::vector<double> quality_of(const ListedCells& region, const RunContext& context)
{
    std::vector<double> values = quality::metric_values(region.nodes, region.cells,
                                                        quality::Metric::scaled_jacobian, context);
    parallel_each(context, region.curved.size(), kPerTask, [&](std::size_t c) {
        if (region.curved[c].count == 0) return;
        if (const auto curved = quality::judge_listed(region.nodes, region.curved[c]))
            values[c] = curved->scaled_jacobian;
    });
    return values;
}

} // namespace

DeckCells listed_cells(const io::Deck& deck, const RunContext& context)
{
    DeckCells found;
    std::map<Index, std::size_t> of_region;
    std::map<std::string, std::size_t> of_name; // regions with the same name are merged
    std::vector<Renumbered<Vec3>> numbering;
    for (const io::DeckBlock& block : deck.blocks) {
        const io::DeckShapeInfo& info = io::shape_info(block.shape);
        if (info.dimension != 3) continue;
        const bool curved = info.nodes > info.corners;
        found.second_order = found.second_order || curved;
        for (std::size_t e = 0; e < block.count(); ++e) {
            const Index region = block.regions.empty() ? -1 : block.regions[e];
            const auto [at, first] = of_region.try_emplace(region, found.regions.size());
            std::string name;
            if (first) {
                if (region >= 0) name = deck.regions[index(region)].name;
                if (name.empty()) name = formatted("region {}", found.regions.size() + 1);
                at->second = of_name.try_emplace(name, found.regions.size()).first->second;
            }
            if (at->second == found.regions.size()) {
                found.regions.emplace_back().name = name;
                numbering.emplace_back(deck.points);
            }
            ListedCells& cells = found.regions[at->second];
            const auto own = block.element(e);
            Hex cell = mesh::merged_corners(info.corners);
            for (Index& n : cell) n = numbering[at->second](own[index(n)]);
            cells.cells.push_back(cell);
            if (curved && std::find(own.begin(), own.end(), -1) == own.end()) {
                cells.curved.resize(cells.cells.size());
                mesh::CellNodes& nodes = cells.curved.back();
                nodes = mesh::merged_nodes(block.shape, own);
                for (std::size_t k = 0; k < nodes.count; ++k)
                    nodes.node[k] = numbering[at->second](nodes.node[k]);
            } else if (curved) {
                found.straightened = true;
            }
            const bool fits = block.tags[e] <= std::numeric_limits<Index>::max();
            cells.tags.push_back(fits ? static_cast<Index>(block.tags[e]) : 0);
        }
    }
    if (found.regions.empty())
        throw InvalidInput(
            Message("view.no_solids", "view: {} has no solids, so there are no cells to show", deck.path)
                .remedy("use show = \"faces\""));
    check_cancelled(context);

    std::unordered_map<io::DeckTag, std::vector<std::string>> sets_of;
    for (const io::DeckSet& set : deck.sets) {
        if (set.kind != io::DeckSet::Kind::elements || set.name.empty()) continue;
        for (const io::DeckTag tag : set.members) sets_of[tag].push_back(set.name);
    }
    std::map<std::vector<std::string>, Index> of_groups;
    for (const io::DeckBlock& block : deck.blocks) {
        const io::DeckShapeInfo& info = io::shape_info(block.shape);
        if (info.dimension != 2) continue;
        for (std::size_t e = 0; e < block.count(); ++e) {
            const Index region = block.regions.empty() ? -1 : block.regions[e];
            std::vector<std::string> groups;
            if (region >= 0 && !deck.regions[index(region)].name.empty())
                groups.push_back(deck.regions[index(region)].name);
            if (const auto sets = sets_of.find(block.tags[e]); sets != sets_of.end())
                for (const std::string& name : sets->second)
                    if (std::ranges::find(groups, name) == groups.end()) groups.push_back(name);
            const auto [at, fresh] = of_groups.try_emplace(groups, static_cast<Index>(found.patches.size()));
            if (fresh) {
                const bool made_void = std::ranges::any_of(groups, topology::is_void_group);
                found.patches.push_back({static_cast<int>(found.patches.size()) + 1, groups, made_void, 0});
            }
            ++found.patches[index(at->second)].quads;
            const auto own = block.element(e);
            const Quad side{own[0], own[1], own[2], own[info.corners == 3 ? 2 : 3]};
            for (std::size_t r = 0; r < found.regions.size(); ++r) {
                Quad mine = side;
                for (Index& n : mine) n = numbering[r].known(n);
                if (std::find(mine.begin(), mine.end(), -1) != mine.end()) continue;
                found.regions[r].sides.push_back(mine);
                found.regions[r].side_patch.push_back(at->second);
            }
        }
    }
    for (std::size_t r = 0; r < found.regions.size(); ++r) {
        ListedCells& region = found.regions[r];
        region.nodes = std::move(numbering[r].used);
        if (!region.curved.empty()) region.curved.resize(region.cells.size());
        region.quality = quality_of(region, context);
    }
    return found;
}

} // namespace lacuna::view
