// SPDX-License-Identifier: MIT
#include <lacuna/io/partition.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/team.h>

#include <lacuna/io/cell_field.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <string>

namespace lacuna::io {
namespace {

[[noreturn]] void refuse_parts(int parts, std::size_t layers)
{
    throw InvalidInput(Message("io.too_many_parts",
                               "partitions = {}: the mesh has {} layers, and a part is one layer at least",
                               found(parts), needed(layers))
                           .remedy("ask for as many at most"));
}

/// Number of parts of each mesh, if there are more parts than meshes: by its cells.
std::vector<int> parts_of_each(std::span<const mesh::MeshPart> meshes, int parts)
{
    std::vector<int> each(meshes.size(), 1);
    for (auto sum = static_cast<int>(meshes.size()); sum < parts; ++sum) {
        std::size_t largest = meshes.size();
        double most = 0;
        std::size_t layers = 0;
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            layers += index(meshes[m].mesh->layers);
            const double cells = static_cast<double>(meshes[m].mesh->cell_count()) / each[m];
            if (each[m] >= meshes[m].mesh->layers || cells <= most) continue;
            largest = m;
            most = cells;
        }
        if (largest == meshes.size()) refuse_parts(parts, layers);
        ++each[largest];
    }
    return each;
}

/// The part of each layer of each mesh.
std::vector<std::vector<Index>> parts_of_layers(std::span<const mesh::MeshPart> meshes, int parts)
{
    std::vector<std::vector<Index>> all(meshes.size());
    if (meshes.size() < static_cast<std::size_t>(parts)) {
        const std::vector<int> each = parts_of_each(meshes, parts);
        Index next = 0;
        for (std::size_t m = 0; m < meshes.size(); ++m)
            for (const LayerPart& part : layer_parts(meshes[m].mesh->layers, {each[m]}))
                all[m].resize(index(part.last), next++);
        return all;
    }
    // The largest mesh first, each to the part with the fewest cells so far.
    std::vector<std::size_t> order(meshes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, std::greater<>{},
                             [&](std::size_t m) { return meshes[m].mesh->cell_count(); });
    std::vector<std::size_t> cells(static_cast<std::size_t>(parts), 0);
    for (const std::size_t m : order) {
        const auto least = std::ranges::min_element(cells);
        *least += meshes[m].mesh->cell_count();
        all[m].assign(index(meshes[m].mesh->layers), static_cast<Index>(least - cells.begin()));
    }
    return all;
}

/// Finds the parts of which elements are ghosts: row by row, those of elements with a common node.
class GhostFinder {
public:
    GhostFinder(const Deck& deck, DeckPartition& partition) : deck_(deck), partition_(partition) {}

    void find(int rows)
    {
        for (int p = 0; p < partition_.parts; ++p) alone_.push_back(list_of({p}));
        for (const DeckBlock& block : deck_.blocks) reached_.emplace_back(block.count(), Index{0});
        each_solid(
            [&](std::size_t b, std::size_t e) { reached_[b][e] = alone_[index(partition_.part[b][e])]; });
        for (int row = 0; row < rows; ++row) {
            std::vector<Index> at(deck_.points.size(), 0);
            each_solid([&](std::size_t b, std::size_t e) {
                for (const Index node : deck_.blocks[b].element(e))
                    at[index(node)] = joined(at[index(node)], reached_[b][e]);
            });
            each_solid([&](std::size_t b, std::size_t e) {
                for (const Index node : deck_.blocks[b].element(e))
                    reached_[b][e] = joined(reached_[b][e], at[index(node)]);
            });
        }
        each_solid([&](std::size_t b, std::size_t e) {
            std::vector<int> others = partition_.lists[index(reached_[b][e])];
            std::erase(others, partition_.part[b][e]);
            partition_.ghost_of[b][e] = list_of(others);
        });
    }

private:
    template <class Visit>
    void each_solid(const Visit& visit) const
    {
        for (std::size_t b = 0; b < deck_.blocks.size(); ++b)
            for (std::size_t e = 0;
                 shape_info(deck_.blocks[b].shape).dimension == 3 && e < deck_.blocks[b].count(); ++e)
                visit(b, e);
    }
    Index list_of(const std::vector<int>& parts)
    {
        const auto [at, fresh] = known_.try_emplace(parts, static_cast<Index>(partition_.lists.size()));
        if (fresh) partition_.lists.push_back(parts);
        return at->second;
    }
    /// The union of two lists.
    Index joined(Index a, Index b)
    {
        if (a == b || b == 0) return a;
        if (a == 0) return b;
        const auto [at, fresh] = unions_.try_emplace(std::minmax(a, b), 0);
        if (fresh) {
            std::vector<int> all;
            std::ranges::set_union(partition_.lists[index(a)], partition_.lists[index(b)],
                                   std::back_inserter(all));
            at->second = list_of(all);
        }
        return at->second;
    }

    const Deck& deck_;
    DeckPartition& partition_;
    std::vector<std::vector<Index>> reached_; ///< of each solid, a list with its own part
    std::vector<Index> alone_;
    std::map<std::vector<int>, Index> known_{{{}, 0}};
    std::map<std::pair<Index, Index>, Index> unions_;
};

} // namespace

DeckPartition partition_of(const Deck& deck, std::span<const mesh::MeshPart> meshes,
                           const PartitionOptions& options)
{
    DeckPartition partition;
    partition.parts = std::max(options.parts, 1);
    const std::vector<std::vector<Index>> of_layer = parts_of_layers(meshes, partition.parts);
    const auto part_of_cell = [&](std::size_t m, std::size_t cell) {
        return of_layer[m][cell / meshes[m].mesh->quads.size()];
    };
    for (const DeckBlock& block : deck.blocks) {
        partition.part.emplace_back(block.count(), Index{0});
        partition.ghost_of.emplace_back(block.count(), Index{0});
    }
    // Solids lie in their blocks mesh after mesh; a mesh numbers its cells, then its skin.
    std::vector<DeckTag> first(meshes.size(), 0);
    std::vector<std::size_t> next(deck.blocks.size(), 0);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const mesh::CellKinds kinds(*meshes[m].mesh);
        const std::size_t cells = meshes[m].mesh->cell_count();
        for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
            const DeckShapeInfo& info = shape_info(deck.blocks[b].shape);
            if (info.dimension != 3) continue;
            const std::size_t from = info.corners == 8 ? 0 : kinds.hexes();
            const std::size_t to = info.corners == 8 ? kinds.hexes() : cells;
            for (std::size_t i = from; i < to; ++i, ++next[b]) {
                const std::size_t cell = kinds.cell(i);
                partition.part[b][next[b]] = part_of_cell(m, cell);
                first[m] = deck.blocks[b].tags[next[b]] - static_cast<DeckTag>(cell);
            }
        }
    }
    std::vector<std::vector<std::uint32_t>> behind;
    for (const mesh::MeshPart& part : meshes) behind.push_back(cells_of_skin(*part.mesh));
    for (std::size_t b = 0; b < deck.blocks.size(); ++b) {
        const DeckBlock& block = deck.blocks[b];
        if (shape_info(block.shape).dimension != 2) continue;
        for (std::size_t e = 0; e < block.count(); ++e) {
            const auto m = static_cast<std::size_t>(std::ranges::upper_bound(first, block.tags[e]) -
                                                    first.begin() - 1);
            const auto quad = static_cast<std::size_t>(block.tags[e] - first[m]) -
                              meshes[m].mesh->cell_count();
            partition.part[b][e] = part_of_cell(m, behind[m][quad]);
        }
    }
    if (options.ghosts > 0) GhostFinder(deck, partition).find(options.ghosts);
    return partition;
}

std::vector<LayerPart> layer_parts(int layers, const PartitionOptions& options)
{
    const auto parts = static_cast<std::size_t>(std::max(options.parts, 1));
    if (parts > static_cast<std::size_t>(layers))
        refuse_parts(options.parts, static_cast<std::size_t>(layers));
    std::vector<LayerPart> all;
    for (std::size_t p = 0; p < parts; ++p) {
        const auto [begin, end] = share_of(p, parts, static_cast<std::size_t>(layers));
        const int first = static_cast<int>(begin), last = static_cast<int>(end);
        const int ghosts = std::min(options.ghosts, layers);
        all.push_back({first, last, std::max(first - ghosts, 0), std::min(last + ghosts, layers)});
    }
    return all;
}

} // namespace lacuna::io
