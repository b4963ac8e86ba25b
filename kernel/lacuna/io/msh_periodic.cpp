// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/msh.h>

#include <algorithm>
#include <map>
#include <utility>

namespace lacuna::io {

using mesh::MeshView;

namespace {

/// The link between two surfaces. In version 2.2 it is text in binary files too.
std::string periodic_link(const MeshView& view, const MshNumbers& numbers, bool old,
                          const Eigen::Isometry3d& onto, std::size_t entity, std::size_t master,
                          const std::map<Index, Index>& nodes)
{
    const MshNumbers to{numbers.binary && !old};
    std::string text = to.line(2, view.entities[entity].tag, view.entities[master].tag);
    if (old)
        text += "Affine";
    else
        text += to.line(MshNumbers::size_of(16));
    if (!to.binary && !old) text.back() = ' ';
    for (Eigen::Index i = 0; i < 4; ++i)
        for (Eigen::Index j = 0; j < 4; ++j) {
            if (!to.binary) text += ' ';
            text += to.line(onto.matrix()(i, j));
            if (!to.binary) text.pop_back();
        }
    if (!to.binary) text += '\n';
    text += to.line(MshNumbers::size_of(nodes.size()));
    for (const auto& [slave, node] : nodes)
        text += to.line(static_cast<std::uint64_t>(view.point_tags[index(slave)]),
                        static_cast<std::uint64_t>(view.point_tags[index(node)]));
    return text;
}

} // namespace

std::string msh_periodic(const MeshView& view, const MshNumbers& numbers, bool old)
{
    std::string all;
    std::size_t links = 0;
    for (const MeshView::Periodic& own : view.periodic) {
        std::map<Index, Index> from; // for each node of the second side, its partner on the first
        for (const auto& [a, b] : own.nodes.pairs) from.emplace(b, a);
        // The surface of each quad, by the quad's sorted nodes; and for each quad on the second side its
        // surface and nodes.
        std::map<std::vector<Index>, std::size_t> entity_of;
        std::vector<std::pair<std::size_t, std::vector<Index>>> sides;
        for (const MeshView::Block& block : view.blocks) {
            if (shape_info(block.shape).dimension != 2) continue;
            mesh::each_run(block.entities, 0, block.count, [&](std::size_t first, std::size_t last, Index e) {
                block.each_cell(first, last, [&](std::size_t, std::span<const Index> nodes) {
                    std::vector<Index> key(nodes.begin(), nodes.end());
                    if (std::ranges::all_of(key, [&](Index n) { return from.contains(n); }))
                        sides.emplace_back(index(e), key);
                    std::ranges::sort(key);
                    entity_of.emplace(std::move(key), index(e));
                });
            });
        }
        std::map<std::pair<std::size_t, std::size_t>, std::map<Index, Index>> pairs; // pairs of nodes, by
                                                                                     // both surfaces
        for (const auto& [entity, nodes] : sides) {
            std::vector<Index> key;
            for (const Index n : nodes) key.push_back(from.at(n));
            std::ranges::sort(key);
            const auto master = entity_of.find(key);
            if (master == entity_of.end()) continue;
            for (const Index n : nodes) pairs[{entity, master->second}][n] = from.at(n);
        }
        for (const auto& [entities, nodes] : pairs) {
            all += periodic_link(view, numbers, old, own.nodes.onto, entities.first, entities.second, nodes);
            ++links;
        }
    }
    if (links == 0) return {};
    return "$Periodic\n" + (old ? std::to_string(links) + "\n" : numbers.line(MshNumbers::size_of(links))) +
           all + (old ? "" : numbers.gap()) + "$EndPeriodic\n";
}

} // namespace lacuna::io
