// SPDX-License-Identifier: MIT
#include <lacuna/fill/shared/cell_data.h>

#include <lacuna/core/error.h>

#include <algorithm>
#include <utility>

namespace lacuna::fill {

using mesh::CellShape;

namespace {

/// The cells of a shape in one part: the position of the first cell, and their number.
std::pair<std::size_t, std::size_t> cells_of(const mesh::HexMesh& mesh, CellShape shape)
{
    if (shape == CellShape::hex8) return {0, mesh.hex_count()};
    return {mesh.hex_count(), shape == CellShape::wedge6 ? mesh.wedge_count() : 0};
}
std::pair<std::size_t, std::size_t> cells_of(const mesh::TetPart& mesh, CellShape shape)
{
    if (shape == CellShape::pyramid5) return {0, mesh.pyramids};
    return {mesh.pyramids, shape == CellShape::tet4 ? mesh.cells.size() - mesh.pyramids : 0};
}

/// The corners of a cell, by their numbers in the whole mesh.
template <class Number>
mesh::CellNodes corners_of(const Hex& hex, const Number& number)
{
    mesh::CellNodes corners = mesh::distinct_corners(hex);
    for (std::size_t k = 0; k < corners.count; ++k) corners.node[k] = number(corners.node[k]);
    return corners;
}

std::size_t corner_count(CellShape shape)
{
    return static_cast<std::size_t>(mesh::shape_info(shape).corners);
}

bool has_shape(const io::DeckBlock& block, CellShape shape)
{
    return io::shape_info(block.shape).corners == mesh::shape_info(shape).corners;
}

template <class Nodes>
void add_row(CellRows& rows, const Nodes& nodes)
{
    rows.columns = static_cast<std::size_t>(std::ranges::distance(nodes));
    for (const Index node : nodes) rows.nodes.push_back(node + 1);
}

void require_defined(quality::Metric metric, CellShape of)
{
    using enum quality::Metric;
    if (of == CellShape::hex8 || metric == scaled_jacobian || metric == jacobian || metric == volume) return;
    throw InvalidInput(
        Message("lua.bad_value", "field: '{}' is defined for hexahedra only", quality::metric_name(metric))
            .remedy("use \"scaled_jacobian\", \"jacobian\" or \"volume\""));
}

} // namespace

const char* shape_name(CellShape shape)
{
    switch (shape) {
    case CellShape::wedge6:
        return "wedge";
    case CellShape::pyramid5:
        return "pyramid";
    case CellShape::tet4:
        return "tet";
    case CellShape::quad4:
        return "quad";
    case CellShape::tri3:
        return "triangle";
    default:
        return "hex";
    }
}

int order(const FilledVolume& mesh) { return mesh.swept.mesh.order(); }
int order(const FilledParts& mesh)
{
    return mesh.swept.parts.empty() ? mesh.tets.front().mesh.order() : mesh.swept.parts.front().mesh.order();
}
int order(const FilledShell& mesh)
{
    return std::ranges::any_of(mesh.deck.blocks,
                               [](const io::DeckBlock& block) {
                                   return io::shape_info(block.shape).nodes >
                                          io::shape_info(block.shape).corners;
                               })
               ? 2
               : 1;
}

std::size_t node_count(const FilledVolume& mesh) { return mesh.swept.mesh.node_count(); }
std::size_t node_count(const FilledParts& mesh) { return mesh.swept.nodes; }
std::size_t node_count(const FilledShell& mesh) { return mesh.deck.points.size(); }

Vec3 node(const FilledParts& mesh, std::size_t node)
{
    if (!mesh.owner.empty()) {
        const std::size_t part = index(mesh.owner[node][0]), swept = mesh.swept.parts.size();
        return part < swept ? mesh.swept.parts[part].mesh.node(index(mesh.owner[node][1]))
                            : mesh.tets[part - swept].mesh.node(index(mesh.owner[node][1]));
    }
    for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p) {
        const mesh::NodeNumbers& number = mesh.swept.numbering[p];
        const std::size_t fresh = node - index(number.first()); // index among the nodes numbered first here
        if (fresh < number.fresh())
            return mesh.swept.parts[p].skin()[static_cast<Index>(number.fresh_node(fresh))];
    }
    for (const FilledTets& tets : mesh.tets)
        if (const auto at = std::ranges::find(tets.number, static_cast<Index>(node)); at != tets.number.end())
            return tets.mesh.node(static_cast<std::size_t>(at - tets.number.begin()));
    return Vec3::Zero(); // excluded by the precondition
}
Vec3 node(const FilledVolume& mesh, std::size_t node) { return mesh.swept.mesh.node(node); }
Vec3 node(const FilledShell& mesh, std::size_t node) { return mesh.deck.points[node]; }

std::size_t cell_count(const FilledVolume& mesh, CellShape shape)
{
    return cells_of(mesh.swept.mesh, shape).second;
}
std::size_t cell_count(const FilledShell& mesh, CellShape shape)
{
    std::size_t count = 0;
    for (const io::DeckBlock& block : mesh.deck.blocks)
        if (has_shape(block, shape)) count += block.count();
    return count;
}

std::size_t cell_count(const FilledParts& mesh, CellShape shape)
{
    std::size_t count = 0;
    for (const sweep::Swept& part : mesh.swept.parts) count += cells_of(part.mesh, shape).second;
    for (const FilledTets& tets : mesh.tets) count += cells_of(tets.mesh, shape).second;
    return count;
}

mesh::CellNodes cell(const FilledParts& mesh, CellShape shape, std::size_t number)
{
    for (std::size_t p = 0; p < mesh.swept.parts.size(); ++p) {
        const mesh::HexMesh& part = mesh.swept.parts[p].mesh;
        const auto [first, count] = cells_of(part, shape);
        if (number < count)
            return corners_of(part.hex(mesh::CellKinds(part).cell(first + number)),
                              [&](Index n) { return mesh.swept.numbering[p].of(n); });
        number -= count;
    }
    std::size_t t = 0;
    for (; number >= cells_of(mesh.tets[t].mesh, shape).second; ++t)
        number -= cells_of(mesh.tets[t].mesh, shape).second;
    const auto first = cells_of(mesh.tets[t].mesh, shape).first;
    return corners_of(mesh.tets[t].mesh.cells[first + number],
                      [&](Index n) { return mesh.tets[t].number[index(n)]; });
}
mesh::CellNodes cell(const FilledVolume& mesh, CellShape shape, std::size_t number)
{
    const mesh::HexMesh& cells = mesh.swept.mesh;
    return mesh::distinct_corners(
        cells.hex(mesh::CellKinds(cells).cell(cells_of(cells, shape).first + number)));
}
mesh::CellNodes cell(const FilledShell& mesh, CellShape shape, std::size_t number)
{
    const io::DeckBlock& block = *std::ranges::find_if(
        mesh.deck.blocks, [&](const io::DeckBlock& of) { return has_shape(of, shape); });
    mesh::CellNodes corners;
    corners.count = corner_count(shape);
    std::ranges::copy(block.element(number).first(corners.count), corners.node.begin());
    return corners;
}

std::vector<Group> groups(const FilledShell& mesh)
{
    std::vector<Group> groups;
    for (const io::DeckRegion& region : mesh.deck.regions) groups.push_back({region.name, 2, 0});
    for (const io::DeckBlock& block : mesh.deck.blocks)
        for (const Index region : block.regions) ++groups[index(region)].cells;
    for (const io::DeckSet& set : mesh.deck.sets) groups.push_back({set.name, 2, set.members.size()});
    return groups;
}

std::vector<Vec3> points(const FilledVolume& mesh)
{
    std::vector<Vec3> points = mesh.swept.mesh.nodes;
    const std::vector<Vec3>& middles = mesh.swept.mesh.middles.nodes;
    points.insert(points.end(), middles.begin(), middles.end());
    return points;
}
std::vector<Vec3> points(const FilledParts& mesh) { return whole_cells(mesh).nodes; }
std::vector<Vec3> points(const FilledShell& mesh) { return mesh.deck.points; }

CellRows cell_rows(const FilledVolume& mesh, CellShape shape)
{
    const mesh::HexMesh& cells = mesh.swept.mesh;
    const mesh::CellKinds kinds(cells);
    const auto [first, count] = cells_of(cells, shape);
    CellRows rows{{}, corner_count(shape)};
    for (std::size_t i = 0; i < count; ++i) add_row(rows, mesh::cell_nodes(cells, kinds.cell(first + i)));
    return rows;
}
CellRows cell_rows(const FilledParts& mesh, CellShape shape)
{
    const WholeCells whole = whole_cells(mesh);
    CellRows rows{{}, corner_count(shape)};
    for (std::size_t c = 0; c < whole.hexes.size(); ++c) {
        const mesh::CellNodes corners = mesh::distinct_corners(whole.hexes[c]);
        if (corners.count == corner_count(shape))
            add_row(rows, whole.curved.empty() ? corners : whole.curved[c]);
    }
    return rows;
}
CellRows cell_rows(const FilledShell& mesh, CellShape shape)
{
    CellRows rows{{}, corner_count(shape)};
    for (const io::DeckBlock& block : mesh.deck.blocks)
        for (std::size_t e = 0; e < block.count() && has_shape(block, shape); ++e)
            add_row(rows, block.element(e));
    return rows;
}

std::vector<double> cell_values(const FilledVolume& mesh, quality::Metric metric, CellShape shape,
                                const RunContext& context)
{
    require_defined(metric, shape);
    const mesh::HexMesh& cells = mesh.swept.mesh;
    const auto [first, count] = cells_of(cells, shape);
    std::vector<double> values;
    if (count == 0) return values;
    const std::vector<double> all = quality::metric_values(cells, metric, context);
    const mesh::CellKinds kinds(cells);
    for (std::size_t i = 0; i < count; ++i) values.push_back(all[kinds.cell(first + i)]);
    return values;
}
std::vector<double> cell_values(const FilledParts& mesh, quality::Metric metric, CellShape shape,
                                const RunContext& context)
{
    require_defined(metric, shape);
    const WholeCells whole = whole_cells(mesh);
    const std::vector<double> all = quality::metric_values(whole.nodes, whole.hexes, metric, context);
    std::vector<double> values;
    for (std::size_t c = 0; c < all.size(); ++c)
        if (mesh::distinct_corners(whole.hexes[c]).count == corner_count(shape)) values.push_back(all[c]);
    return values;
}

} // namespace lacuna::fill
