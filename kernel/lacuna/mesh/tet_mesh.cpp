// SPDX-License-Identifier: MIT
#include <lacuna/mesh/tet_mesh.h>

#include <algorithm>

namespace lacuna::mesh {
namespace {

/// Append the middle nodes of item `i`, from a list of the middle nodes of all items. The first `large` items
/// have `of_large` middle nodes each, the others `of_small`.
void add_middles(const std::vector<Index>& middles, std::size_t i, std::size_t large, std::size_t of_large,
                 std::size_t of_small, CellNodes& nodes)
{
    const bool is_large = i < large;
    const std::size_t begin = is_large ? i * of_large : large * of_large + (i - large) * of_small;
    const std::size_t count = is_large ? of_large : of_small;
    std::copy_n(middles.begin() + static_cast<std::ptrdiff_t>(begin), count,
                nodes.node.begin() + nodes.count);
    nodes.count += count;
}

} // namespace

CellNodes merged_nodes(CellShape shape, std::span<const Index> own)
{
    const CellShapeInfo& info = shape_info(shape);
    CellNodes nodes;
    if (info.corners == 8) {
        nodes.count = own.size();
        std::ranges::copy(own, nodes.node.begin());
        return nodes;
    }
    const Hex at = merged_corners(info.corners);
    for (const Index corner : at) nodes.node[nodes.count++] = own[index(corner)];
    if (info.nodes == info.corners) return nodes;
    const auto sides = side_corners(shape);
    for (const auto& [from, to] : kHexEdges) {
        const int a = at[index(from)], b = at[index(to)];
        const auto side = std::ranges::find_if(
            sides, [&](const auto& of) { return of == std::pair(a, b) || of == std::pair(b, a); });
        const auto middle = static_cast<std::size_t>(info.corners + (side - sides.begin()));
        nodes.node[nodes.count++] = own[side == sides.end() ? index(a) : middle];
    }
    if (shape == CellShape::pyramid14) nodes.node[nodes.count++] = own.back();
    return nodes;
}

CellShape cell_shape(const TetPart& mesh, bool is_pyramid)
{
    using enum CellShape;
    if (mesh.order() == 1) return is_pyramid ? pyramid5 : tet4;
    return !is_pyramid ? tet10 : mesh.middles.full ? pyramid14 : pyramid13;
}

CellShape skin_shape(const TetPart& mesh, bool is_quad)
{
    using enum CellShape;
    if (mesh.order() == 1) return is_quad ? quad4 : tri3;
    return !is_quad ? tri6 : mesh.middles.full ? quad9 : quad8;
}

CellNodes cell_nodes(const TetPart& mesh, std::size_t cell)
{
    CellNodes nodes = distinct_corners(mesh.cells[cell]);
    if (mesh.order() == 1) return nodes;
    add_middles(mesh.middles.of_cells, cell, mesh.pyramids, mesh.middles.full ? 9 : 8, 6, nodes);
    return nodes;
}

CellNodes merged_nodes(const TetPart& mesh, std::size_t cell)
{
    const CellNodes own = cell_nodes(mesh, cell);
    return merged_nodes(cell_shape(mesh, cell < mesh.pyramids), own.all());
}

CellNodes skin_nodes(const TetPart& mesh, std::size_t i)
{
    const Quad& quad = mesh.skin[i];
    CellNodes nodes{{quad[0], quad[1], quad[2], quad[3]}, corner_count(quad)};
    if (mesh.order() == 1) return nodes;
    add_middles(mesh.middles.of_skin, i, mesh.skin_quads, mesh.middles.full ? 5 : 4, 3, nodes);
    return nodes;
}

} // namespace lacuna::mesh
