// SPDX-License-Identifier: MIT
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/quad_mesh.h>
#include <lacuna/mesh/shared/incidence.h>

#include <algorithm>

namespace lacuna::mesh {

std::vector<BoundarySide> boundary_sides(const std::vector<Quad>& quads)
{
    Index highest = -1;
    for (const Quad& quad : quads) highest = std::max(highest, *std::max_element(quad.begin(), quad.end()));
    const std::vector<Index> opposite = opposite_sides(quads, highest + 1);
    std::vector<BoundarySide> result;
    for (std::size_t side = 0; side < opposite.size(); ++side) {
        const Quad& quad = quads[side / 4];
        if (opposite[side] == kRimSide)
            result.push_back({quad[side % 4], quad[(side + 1) % 4], static_cast<Index>(side / 4)});
    }
    return result;
}

std::vector<Index> opposite_sides(const std::vector<Quad>& quads, Index node_count)
{
    // Sides with the same nodes are found through their lower node: each node has a list of the sides of
    // which it is the lower node. This list is not longer than the valence of the node.
    struct SideUse {
        Index high, first, second; ///< the other node, and the sides of one or two quads; kRimSide: none yet
    };
    const auto each_side = [&](const auto& visit) {
        for (std::size_t q = 0; q < quads.size(); ++q)
            for (std::size_t i = 0; i < 4; ++i)
                if (is_side(quads[q], i))
                    visit(quads[q][i], quads[q][(i + 1) % 4], static_cast<Index>(4 * q + i));
    };
    std::vector<Index> start(index(node_count) + 1, 0);
    each_side([&](Index a, Index b, Index) { ++start[index(std::min(a, b)) + 1]; });
    for (std::size_t n = 1; n < start.size(); ++n) start[n] += start[n - 1];

    std::vector<SideUse> uses(index(start.back()));
    std::vector<Index> end(start.begin(), start.end() - 1), opposite(4 * quads.size(), kRimSide);
    for (std::size_t q = 0; q < quads.size(); ++q)
        if (is_triangle(quads[q])) opposite[4 * q + 2] = kNoSide;
    each_side([&](Index a, Index b, Index number) {
        const std::size_t low = index(std::min(a, b));
        const Index high = std::max(a, b);
        std::size_t u = index(start[low]);
        while (u < index(end[low]) && uses[u].high != high) ++u;
        if (u == index(end[low])) {
            uses[u] = {high, number, kRimSide};
            ++end[low];
            return;
        }
        SideUse& use = uses[u];
        const bool turned = a != b && quads[index(use.first / 4)][index(use.first % 4)] == b;
        if (use.second == kRimSide && turned) {
            opposite[index(use.first)] = number;
            opposite[index(number)] = use.first;
            use.second = number;
            return;
        }
        if (use.second != kRimSide) opposite[index(use.second)] = kBadSide;
        opposite[index(use.first)] = opposite[index(number)] = kBadSide;
        use.second = number;
    });
    return opposite;
}

Incidence quads_at_nodes(std::span<const Quad> quads, std::size_t node_count)
{
    return incidence(node_count, [&](const auto& visit) {
        for (std::size_t q = 0; q < quads.size(); ++q)
            for (std::size_t k = 0; k < corner_count(quads[q]); ++k)
                visit(index(quads[q][k]), static_cast<Index>(q));
    });
}

SkinQuad skin_quad(const HexMesh& mesh, std::size_t i)
{
    const std::size_t quads = mesh.quads.size();
    if (i < quads) {
        const Quad& q = mesh.quads[i];
        return {turned_over(q), mesh.source_patch[i]};
    }
    i -= quads;
    if (i < quads) {
        const Quad& q = mesh.quads[i];
        const Index top = mesh.layers * mesh.nodes_per_layer;
        return {{top + q[0], top + q[1], top + q[2], top + q[3]}, mesh.target_patch[i]};
    }
    i -= quads;
    const auto low = static_cast<Index>(i / mesh.rim.size()) * mesh.nodes_per_layer;
    const Index high = low + mesh.nodes_per_layer;
    const Segment& side = mesh.rim[i % mesh.rim.size()];
    return {{low + side[0], low + side[1], high + side[1], high + side[0]}, mesh.wall_patch[i]};
}

} // namespace lacuna::mesh
