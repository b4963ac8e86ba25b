// SPDX-License-Identifier: MIT
#include <lacuna/mesh/second_order.h>

#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/layered_nodes.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>

namespace lacuna::mesh {

MiddlePlaces::MiddlePlaces(const HexMesh& mesh)
    : sides_(mesh.middles.sides.size()),
      nodes_(index(mesh.nodes_per_layer)),
      layers_(static_cast<std::size_t>(mesh.layers)),
      on_level_(sides_ + (mesh.middles.full ? mesh.quads.size() : 0)),
      period_(on_level_ + nodes_ + (mesh.middles.full ? sides_ + mesh.quads.size() : 0))
{
}

MiddleNodes number_sides(const HexMesh& mesh, bool full)
{
    MiddleNodes middles;
    middles.full = full;
    middles.side_of.assign(mesh.quads.size(), {-1, -1, -1, -1});
    const std::vector<Index> opposite = opposite_sides(mesh.quads, mesh.nodes_per_layer);
    std::vector<Index> rim_from(index(mesh.nodes_per_layer), -1); // the rim side that starts at each node
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        for (std::size_t k = 0; k < 4; ++k) {
            const Index other = opposite[4 * q + k];
            Index& side = middles.side_of[q][k];
            if (other >= 0 && static_cast<std::size_t>(other) < 4 * q + k) {
                side = middles.side_of[index(other) / 4][index(other) % 4];
                continue;
            }
            side = static_cast<Index>(middles.sides.size());
            const Index a = mesh.quads[q][k], b = mesh.quads[q][(k + 1) % 4];
            middles.sides.push_back({std::min(a, b), std::max(a, b)});
            if (other < 0) rim_from[index(a)] = side;
        }
    }
    for (const Segment& side : mesh.rim) middles.rim_side.push_back(rim_from[index(side[0])]);
    return middles;
}

CellNodes cell_nodes(const HexMesh& mesh, std::size_t cell)
{
    CellNodes nodes;
    const Hex corners = mesh.hex(cell);
    std::copy(corners.begin(), corners.end(), nodes.node.begin());
    nodes.count = 8;
    if (is_wedge(corners)) {
        const Wedge wedge = wedge_of(corners);
        std::copy(wedge.begin(), wedge.end(), nodes.node.begin());
        nodes.count = wedge.size();
    }
    if (mesh.middles.empty()) return nodes;
    const MiddlePlaces places(mesh);
    const std::size_t q = cell % mesh.quads.size(), layer = cell / mesh.quads.size();
    const auto add = [&](std::size_t place) {
        nodes.node[nodes.count++] = static_cast<Index>(corner_count(mesh) + place);
    };
    const Quad& sides = mesh.middles.side_of[q];
    for (const std::size_t level : {layer, layer + 1})
        for (const Index side : sides) add(places.side(level, side));
    for (const Index node : mesh.quads[q]) add(places.upright(layer, node));
    if (!mesh.middles.full) return nodes;
    for (const std::size_t k : {3, 1, 0, 2}) add(places.face(layer, sides[k]));
    for (const std::size_t level : {layer, layer + 1}) add(places.quad(level, q));
    add(places.cell(layer, q));
    return nodes;
}

CellNodes skin_nodes(const HexMesh& mesh, std::size_t i)
{
    CellNodes nodes;
    const Quad corners = skin_quad(mesh, i).nodes;
    std::copy(corners.begin(), corners.end(), nodes.node.begin());
    nodes.count = corner_count(corners);
    if (mesh.middles.empty()) return nodes;
    const MiddlePlaces places(mesh);
    const auto layers = static_cast<std::size_t>(mesh.layers);
    const auto add = [&](std::size_t place) {
        nodes.node[nodes.count++] = static_cast<Index>(corner_count(mesh) + place);
    };
    const std::size_t quads = mesh.quads.size();
    if (i < quads) {
        for (const std::size_t k : {3, 2, 1, 0}) add(places.side(0, mesh.middles.side_of[i][k]));
        if (mesh.middles.full) add(places.quad(0, i));
        return nodes;
    }
    i -= quads;
    if (i < quads) {
        for (const Index side : mesh.middles.side_of[i]) add(places.side(layers, side));
        if (mesh.middles.full) add(places.quad(layers, i));
        return nodes;
    }
    i -= quads;
    const std::size_t layer = i / mesh.rim.size(), r = i % mesh.rim.size();
    add(places.side(layer, mesh.middles.rim_side[r]));
    add(places.upright(layer, mesh.rim[r][1]));
    add(places.side(layer + 1, mesh.middles.rim_side[r]));
    add(places.upright(layer, mesh.rim[r][0]));
    if (mesh.middles.full) add(places.face(layer, mesh.middles.rim_side[r]));
    return nodes;
}

std::array<Vec3, 27> as_hex27(std::span<const Vec3> places)
{
    std::array<Vec3, 27> all;
    std::copy(places.begin(), places.end(), all.begin());
    if (places.size() == 27) return all;
    if (places.size() == 8) {
        for (std::size_t e = 0; e < 12; ++e)
            all[8 + e] = (all[index(kHexEdges[e][0])] + all[index(kHexEdges[e][1])]) / 2;
    }
    Vec3 edges = Vec3::Zero(), corners = Vec3::Zero();
    for (std::size_t f = 0; f < 6; ++f) {
        Vec3 middle = Vec3::Zero();
        for (std::size_t k = 0; k < 4; ++k)
            middle += all[8 + index(kHexFaceEdges[f][k])] / 2 - all[index(kHexFaces[f][k])] / 4;
        all[20 + f] = middle;
    }
    for (std::size_t e = 0; e < 12; ++e) edges += all[8 + e];
    for (std::size_t c = 0; c < 8; ++c) corners += all[c];
    all[26] = edges / 4 - corners / 4;
    return all;
}

} // namespace lacuna::mesh
