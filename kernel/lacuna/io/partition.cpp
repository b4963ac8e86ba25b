// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/deck_view.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/team.h>
#include <lacuna/io/cell_field.h>
#include <lacuna/io/detail/deck_builder.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace lacuna::io {
namespace {

using mesh::MeshView;

[[noreturn]] void refuse_parts(int parts, std::size_t layers)
{
    throw InvalidInput(
        Message("io.too_many_parts",
                "partitions = {}: each partition needs at least one layer, but the number of layers is {}",
                found(parts), needed(layers))
            .remedy("use partitions = {} or fewer", layers));
}

/// Number of parts of each mesh, in proportion to its cells. Used if there are more parts than meshes.
std::vector<int> parts_of_each(std::span<const BulkPart> meshes, int parts)
{
    std::vector<int> each(meshes.size(), 1);
    for (auto sum = static_cast<int>(meshes.size()); sum < parts; ++sum) {
        std::size_t largest = meshes.size();
        double most = 0;
        std::size_t layers = 0;
        for (std::size_t m = 0; m < meshes.size(); ++m) {
            layers += index(meshes[m].mesh.layers);
            const double cells = static_cast<double>(meshes[m].mesh.cell_count()) / each[m];
            if (each[m] >= meshes[m].mesh.layers || cells <= most) continue;
            largest = m;
            most = cells;
        }
        if (largest == meshes.size()) refuse_parts(parts, layers);
        ++each[largest];
    }
    return each;
}

/// For each mesh, the part of each of its layers.
std::vector<std::vector<Index>> parts_of_layers(std::span<const BulkPart> meshes, int parts)
{
    std::vector<std::vector<Index>> all(meshes.size());
    if (meshes.size() < static_cast<std::size_t>(parts)) {
        const std::vector<int> each = parts_of_each(meshes, parts);
        Index next = 0;
        for (std::size_t m = 0; m < meshes.size(); ++m)
            for (const LayerPart& part : layer_parts(meshes[m].mesh.layers, {each[m]}))
                all[m].resize(index(part.last), next++);
        return all;
    }
    // Assign the meshes from the largest to the smallest, each to the part that has the fewest cells so far.
    std::vector<std::size_t> order(meshes.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::ranges::stable_sort(order, std::greater<>{},
                             [&](std::size_t m) { return meshes[m].mesh.cell_count(); });
    std::vector<std::size_t> cells(static_cast<std::size_t>(parts), 0);
    for (const std::size_t m : order) {
        const auto least = std::ranges::min_element(cells);
        *least += meshes[m].mesh.cell_count();
        all[m].assign(index(meshes[m].mesh.layers), static_cast<Index>(least - cells.begin()));
    }
    return all;
}

/// Assigns the elements of a view to parts. Lists of parts are stored once, in `lists_`, and referred to by
/// index; list 0 is empty.
class Divider {
public:
    Divider(const MeshView& view, std::span<const BulkPart> meshes, int parts) : view_(view), meshes_(meshes)
    {
        parts_.parts = parts;
        of_layer_ = parts_of_layers(meshes, parts);
        part_.resize(view.blocks.size());
        find_solids();
        find_quads();
    }

    mesh::ViewParts take(int ghosts)
    {
        parts_.has_ghosts = ghosts > 0;
        if (ghosts > 0) find_ghosts(ghosts);
        for (std::size_t b = 0; b < part_.size(); ++b) {
            mesh::Runs& runs = parts_.of.emplace_back();
            for (std::size_t e = 0; e < part_[b].size(); ++e) mesh::add_run(runs, e + 1, part_[b][e]);
        }
        find_points();
        for (const auto& [key, blocks] : ghosts_)
            for (const auto& [block, cells] : blocks)
                parts_.ghosts.push_back({key.first, lists_[index(key.second)], block, cells});
        return std::move(parts_);
    }

private:
    [[nodiscard]] int dimension(std::size_t block) const
    {
        return mesh::shape_info(view_.blocks[block].shape).dimension;
    }
    [[nodiscard]] Index part_of_cell(std::size_t m, std::size_t cell) const
    {
        return of_layer_[m][cell / meshes_[m].mesh.quads.size()];
    }

    /// Find the parts of solids. A block contains the solids of the first mesh, then those of the second, and
    /// so on.
    void find_solids()
    {
        for (std::size_t b = 0; b < part_.size(); ++b) {
            if (dimension(b) != 3) continue;
            const mesh::CellShape shape = view_.blocks[b].shape;
            const std::size_t kind = mesh::shape_info(shape).corners == 8 ? 0 : 1;
            for (std::size_t m = 0; m < meshes_.size(); ++m) {
                const SweptCells& cells = meshes_[m].cells;
                if (cells.shapes()[kind] != shape) continue;
                for (std::size_t i = 0; i < cells.count[kind]; ++i)
                    part_[b].push_back(part_of_cell(m, cells.cell(kind, i)));
            }
        }
    }

    /// Find the parts of quads. Each mesh numbers its cells first, then its skin.
    void find_quads()
    {
        std::vector<std::vector<std::uint32_t>> behind;
        for (const BulkPart& part : meshes_) behind.push_back(cells_of_skin(part.mesh));
        for (std::size_t b = 0; b < part_.size(); ++b) {
            if (dimension(b) != 2) continue;
            const MeshView::Block& block = view_.blocks[b];
            block.tags.each(0, block.count, [&](std::size_t, std::int64_t tag) {
                const auto first = [](const BulkPart& part) { return part.place.first_cell; };
                const auto m = static_cast<std::size_t>(std::ranges::upper_bound(meshes_, tag, {}, first) -
                                                        meshes_.begin() - 1);
                const auto quad = static_cast<std::size_t>(tag - first(meshes_[m])) -
                                  meshes_[m].mesh.cell_count();
                part_[b].push_back(part_of_cell(m, behind[m][quad]));
            });
        }
    }

    /// Find the ghosts of each part, row by row. In each row, an element becomes a ghost of all parts that
    /// reach one of its nodes.
    void find_ghosts(int rows)
    {
        std::vector<Index> alone;
        for (int p = 0; p < parts_.parts; ++p) alone.push_back(list_of({p}));
        std::vector<std::vector<Index>> reached(part_.size()); // for each solid, the number of the list of
                                                               // parts that reach it; at first its own part
        for (std::size_t b = 0; b < part_.size(); ++b)
            for (const Index part : part_[b]) reached[b].push_back(alone[index(part)]);
        for (int row = 0; row < rows; ++row) {
            std::vector<Index> at(view_.points, 0);
            each_solid([&](std::size_t b, std::size_t e, std::span<const Index> nodes) {
                for (const Index node : nodes) at[index(node)] = joined(at[index(node)], reached[b][e]);
            });
            each_solid([&](std::size_t b, std::size_t e, std::span<const Index> nodes) {
                for (const Index node : nodes) reached[b][e] = joined(reached[b][e], at[index(node)]);
            });
        }
        each_solid([&](std::size_t b, std::size_t e, std::span<const Index>) {
            std::vector<int> others = lists_[index(reached[b][e])];
            std::erase(others, part_[b][e]);
            if (!others.empty()) ghosts_[{part_[b][e], list_of(others)}][b].add(e, e + 1);
        });
    }

    template <class Visit>
    void each_solid(const Visit& visit) const
    {
        for (std::size_t b = 0; b < part_.size(); ++b)
            if (dimension(b) == 3)
                view_.blocks[b].each_cell(
                    0, part_[b].size(),
                    [&](std::size_t e, std::span<const Index> nodes) { visit(b, e, nodes); });
    }
    Index list_of(const std::vector<int>& parts)
    {
        const auto [at, fresh] = known_.try_emplace(parts, static_cast<Index>(lists_.size()));
        if (fresh) lists_.push_back(parts);
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
            std::ranges::set_union(lists_[index(a)], lists_[index(b)], std::back_inserter(all));
            at->second = list_of(all);
        }
        return at->second;
    }

    /// Find the owner of each point: the lowest part that uses the point.
    void find_points()
    {
        std::vector<Index> lowest(view_.points, parts_.parts - 1);
        std::vector<std::vector<Index>> used(index(parts_.parts));
        for (std::size_t b = 0; b < part_.size(); ++b)
            view_.blocks[b].each_cell(0, part_[b].size(), [&](std::size_t e, std::span<const Index> nodes) {
                const Index part = part_[b][e];
                for (const Index node : nodes) lowest[index(node)] = std::min(lowest[index(node)], part);
                used[index(part)].insert(used[index(part)].end(), nodes.begin(), nodes.end());
            });
        for (const auto& [key, blocks] : ghosts_)
            for (const auto& [block, cells] : blocks)
                cells.each(0, cells.count(), [&](std::size_t first, std::size_t last) {
                    view_.blocks[block].each_cell(
                        first, last, [&](std::size_t, std::span<const Index> nodes) {
                            for (const int part : lists_[index(key.second)])
                                used[index(part)].insert(used[index(part)].end(), nodes.begin(), nodes.end());
                        });
                });
        for (Index part = 0; part < parts_.parts; ++part) {
            mesh::Ranges own;
            for (std::size_t p = 0; p < lowest.size(); ++p)
                if (lowest[p] == part) own.add(p, p + 1);
            parts_.points.emplace_back(part, std::move(own));
            mesh::Ranges& points = parts_.used.emplace_back();
            tidy(used[index(part)]);
            for (const Index p : used[index(part)]) points.add(index(p), index(p) + 1);
        }
    }

    const MeshView& view_;
    std::span<const BulkPart> meshes_;
    std::vector<std::vector<Index>> of_layer_; ///< part of each layer of each mesh
    std::vector<std::vector<Index>> part_;     ///< part of each element of each block
    /// Ghost elements of each block, by the part that owns them and the list of the parts that have them as
    /// ghosts.
    std::map<std::pair<Index, Index>, std::map<std::size_t, mesh::Ranges>> ghosts_;
    std::vector<std::vector<int>> lists_{{}}; ///< lists of parts, increasing
    std::map<std::vector<int>, Index> known_{{{}, 0}};
    std::map<std::pair<Index, Index>, Index> unions_;
    mesh::ViewParts parts_;
};

} // namespace

mesh::ViewParts parts_of(const MeshView& view, std::span<const BulkPart> parts,
                         const PartitionOptions& options)
{
    return Divider(view, parts, std::max(options.parts, 1)).take(options.ghosts);
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
