// SPDX-License-Identifier: MIT
#include <lacuna/view/detail/cell_set.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/quality/shared/metrics.h>
#include <lacuna/quality/shared/second_order.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

namespace lacuna::view {

namespace {

/// Whether a group belongs to a void face: `void:3`, or `fluid:void:3` in an assembly.
bool is_of_void(const std::string& group)
{
    return group.starts_with("void:") || group.find(":void:") != std::string::npos;
}

} // namespace

std::string counted(std::size_t count, const std::string& what)
{
    return formatted("{} {}{}", count, what, count == 1 ? "" : what.ends_with('x') ? "es" : "s");
}

std::vector<ShownPatch> shown_patches(const mesh::HexMesh& mesh)
{
    std::vector<ShownPatch> shown;
    for (const mesh::SkinPatch& patch : mesh.patches) {
        const bool named_void = std::ranges::any_of(patch.groups, is_of_void);
        shown.push_back({patch.tag, patch.groups, patch.face == 0 && named_void, 0});
    }
    for (const std::vector<Index>* list : {&mesh.source_patch, &mesh.target_patch, &mesh.wall_patch})
        for (const Index patch : *list)
            if (patch >= 0) ++shown[index(patch)].quads;
    return shown;
}

namespace {

/// The eight corners of a solid.
Hex as_hex(std::span<const Index> nodes, int corners)
{
    const auto n = [&](std::size_t k) { return nodes[k]; };
    switch (corners) {
    case 4:
        return {n(0), n(1), n(2), n(2), n(3), n(3), n(3), n(3)};
    case 5:
        return {n(0), n(1), n(2), n(3), n(4), n(4), n(4), n(4)};
    case 6:
        return mesh::hex_of({n(0), n(1), n(2), n(3), n(4), n(5)});
    default:
        return {n(0), n(1), n(2), n(3), n(4), n(5), n(6), n(7)};
    }
}

/// Names of the sets that contain two-dimensional elements.
class SetsOfSides {
public:
    explicit SetsOfSides(const io::Deck& deck)
    {
        for (const io::DeckSet& set : deck.sets) {
            if (set.kind != io::DeckSet::Kind::elements || set.name.empty()) continue;
            for (const io::DeckTag tag : set.members) names_[tag].push_back(set.name);
        }
    }
    [[nodiscard]] std::vector<std::string> of(io::DeckTag tag, const std::string& region) const
    {
        std::vector<std::string> groups;
        if (!region.empty()) groups.push_back(region);
        if (const auto found = names_.find(tag); found != names_.end())
            for (const std::string& name : found->second)
                if (std::find(groups.begin(), groups.end(), name) == groups.end()) groups.push_back(name);
        return groups;
    }

private:
    std::unordered_map<io::DeckTag, std::vector<std::string>> names_;
};

/// Renumbers nodes in the order in which they occur.
class Numbering {
public:
    explicit Numbering(std::size_t points) : number_(points, -1) {}
    Index of(Index point, const std::vector<Vec3>& points, std::vector<Vec3>& nodes)
    {
        Index& number = number_[index(point)];
        if (number < 0) {
            number = static_cast<Index>(nodes.size());
            nodes.push_back(points[index(point)]);
        }
        return number;
    }
    [[nodiscard]] Index known(Index point) const { return number_[index(point)]; }

private:
    std::vector<Index> number_;
};

/// Scaled Jacobian of hexahedra and wedges; NaN for other solids.
std::vector<double> quality_of(const ListedCells& region, const RunContext& context)
{
    std::vector<Hex> measured;
    std::vector<std::size_t> place;
    for (std::size_t c = 0; c < region.cells.size(); ++c) {
        const Hex& cell = region.cells[c];
        if (cell[4] == cell[5]) continue;
        measured.push_back(cell);
        place.push_back(c);
    }
    std::vector<double> values(region.cells.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<double> found = quality::metric_values(region.nodes, measured,
                                                             quality::Metric::scaled_jacobian, context);
    for (std::size_t i = 0; i < found.size(); ++i) values[place[i]] = found[i];
    parallel_for(context, region.curved.size(), quality::kCurvedGrain,
                 [&](std::size_t begin, std::size_t end) {
                     for (std::size_t c = begin; c < end; ++c) {
                         const std::span<const Index> own = region.curved[c].all();
                         if (own.empty()) continue;
                         std::array<Vec3, 27> places;
                         for (std::size_t k = 0; k < own.size(); ++k) places[k] = region.nodes[index(own[k])];
                         const std::array<Vec3, 27> all = mesh::as_hex27(std::span(places).first(own.size()));
                         if (!quality::is_straight(all)) values[c] = quality::judge(all, 0).scaled_jacobian;
                     }
                 });
    return values;
}

} // namespace

DeckCells listed_cells(const io::Deck& deck, const RunContext& context)
{
    DeckCells found;
    std::map<Index, std::size_t> of_region;
    std::map<std::string, std::size_t> of_name; // regions with the same name are merged
    std::vector<Numbering> numbering;
    for (const io::DeckBlock& block : deck.blocks) {
        const io::DeckShapeInfo& info = io::shape_info(block.shape);
        if (info.dimension != 3) continue;
        const bool curved = info.corners == 8 && info.nodes > 8;
        if (info.nodes > info.corners) (curved ? found.second_order : found.straightened) = true;
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
                numbering.emplace_back(deck.points.size());
            }
            ListedCells& cells = found.regions[at->second];
            Hex cell = as_hex(block.element(e), info.corners);
            for (Index& n : cell) n = numbering[at->second].of(n, deck.points, cells.nodes);
            cells.cells.push_back(cell);
            const auto own = block.element(e);
            if (curved && std::find(own.begin(), own.end(), -1) == own.end()) {
                cells.curved.resize(cells.cells.size());
                mesh::CellNodes& nodes = cells.curved.back();
                nodes.count = own.size();
                for (std::size_t k = 0; k < own.size(); ++k)
                    nodes.node[k] = numbering[at->second].of(own[k], deck.points, cells.nodes);
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

    const SetsOfSides sets(deck);
    std::map<std::vector<std::string>, Index> of_groups;
    for (const io::DeckBlock& block : deck.blocks) {
        const io::DeckShapeInfo& info = io::shape_info(block.shape);
        if (info.dimension != 2) continue;
        for (std::size_t e = 0; e < block.count(); ++e) {
            const Index region = block.regions.empty() ? -1 : block.regions[e];
            const auto groups = sets.of(block.tags[e], region < 0 ? "" : deck.regions[index(region)].name);
            const auto [at, fresh] = of_groups.try_emplace(groups, static_cast<Index>(found.patches.size()));
            if (fresh) {
                const bool made_void = std::ranges::any_of(groups, is_of_void);
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
    for (ListedCells& region : found.regions)
        if (!region.curved.empty()) region.curved.resize(region.cells.size());
    for (ListedCells& region : found.regions) region.quality = quality_of(region, context);
    return found;
}

} // namespace lacuna::view
