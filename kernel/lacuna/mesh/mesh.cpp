// SPDX-License-Identifier: MIT
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/mesh/quad_mesh.h>

#include <algorithm>
#include <tuple>

namespace lacuna::mesh {

std::vector<BoundarySide> boundary_sides(const std::vector<Quad>& quads)
{
    struct Side {
        Index low, high, quad;
        int place;
    };
    std::vector<Side> sides;
    sides.reserve(4 * quads.size());
    for (std::size_t q = 0; q < quads.size(); ++q) {
        for (int i = 0; i < 4; ++i) {
            const Index a = quads[q][i];
            const Index b = quads[q][(i + 1) % 4];
            sides.push_back({std::min(a, b), std::max(a, b), static_cast<Index>(q), i});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.quad, a.place) < std::tie(b.low, b.high, b.quad, b.place);
    });

    std::vector<Side> lone;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t j = i + 1;
        while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
        if (j == i + 1) lone.push_back(sides[i]);
        i = j;
    }
    std::sort(lone.begin(), lone.end(),
              [](const Side& a, const Side& b) { return std::tie(a.quad, a.place) < std::tie(b.quad, b.place); });

    std::vector<BoundarySide> result;
    result.reserve(lone.size());
    for (const Side& side : lone) {
        const Quad& quad = quads[static_cast<std::size_t>(side.quad)];
        result.push_back({quad[side.place], quad[(side.place + 1) % 4], side.quad});
    }
    return result;
}

SkinQuad skin_quad(const HexMesh& mesh, std::size_t i)
{
    const std::size_t quads = mesh.quads.size();
    if (i < quads) {
        const Quad& q = mesh.quads[i];
        return {{q[0], q[3], q[2], q[1]}, mesh.source_patch[i]};
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
