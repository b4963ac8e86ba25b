// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/side_nodes.h>

#include <algorithm>

namespace lacuna::io {

using mesh::CellShape;
using mesh::CellSide;

SideNodes::SideNodes(const mesh::MeshView& view)
{
    for (const mesh::MeshView::Set& set : view.sets)
        sides_.insert(sides_.end(), set.sides.begin(), set.sides.end());
    std::ranges::sort(sides_);
    sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
    nodes_.resize(sides_.size());
    if (sides_.empty()) return;
    for (const mesh::MeshView::Block& block : view.blocks) {
        const auto size = static_cast<std::size_t>(shape_info(block.shape).nodes);
        std::array<Index, 27> cell{};
        block.tags.each(0, block.count, [&](std::size_t i, std::int64_t tag) {
            auto at = std::ranges::lower_bound(sides_, tag, {}, &CellSide::element);
            if (at == sides_.end() || at->element != tag) return;
            block.nodes(i, i + 1, cell.data());
            for (; at != sides_.end() && at->element == tag; ++at)
                nodes_[static_cast<std::size_t>(at - sides_.begin())] = nodes_of(
                    block.shape, std::span(cell).first(size), at->side);
        });
    }
}

std::span<const Index> SideNodes::operator[](const CellSide& side) const
{
    const Nodes& nodes =
        nodes_[static_cast<std::size_t>(std::ranges::lower_bound(sides_, side) - sides_.begin())];
    return std::span(nodes.node).first(nodes.count);
}

SideNodes::Nodes SideNodes::nodes_of(CellShape shape, std::span<const Index> cell, int side)
{
    const auto [dimension, corners, count] = shape_info(shape);
    Nodes nodes;
    const auto add = [&](std::size_t k) { nodes.node[nodes.count++] = cell[k]; };
    Quad face{0, 1, 2, corners == 3 ? -1 : 3};
    if (dimension == 3) {
        const auto faces = mesh::face_corners(shape);
        if (side < 1 || side > static_cast<int>(faces.size())) return nodes;
        face = faces[static_cast<std::size_t>(side) - 1];
    } else if (dimension != 2 || side > 0) {
        return nodes;
    } else if (side < 0) {
        std::swap(face[1], face[corners == 3 ? 2 : 3]);
    }
    const std::size_t own = face[3] < 0 ? 3 : 4;
    for (std::size_t k = 0; k < own; ++k) add(index(face[k]));
    if (count == corners) return nodes;
    const auto edges = mesh::side_corners(shape);
    for (std::size_t k = 0; k < own; ++k) {
        const int a = face[k], b = face[(k + 1) % own];
        const auto edge = std::ranges::find_if(
            edges, [&](const auto& of) { return of == std::pair(a, b) || of == std::pair(b, a); });
        add(static_cast<std::size_t>(corners + (edge - edges.begin())));
    }
    constexpr std::size_t kCentres[] = {24, 25, 22, 21, 23, 20}; // centres of hex27 faces S1 … S6
    if (shape == CellShape::quad9) add(8);
    if (shape == CellShape::hex27) add(kCentres[side - 1]);
    return nodes;
}

} // namespace lacuna::io
