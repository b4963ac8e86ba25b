// SPDX-License-Identifier: MIT
#include "support/blocks.h"

#include <lacuna/mesh/quad_mesh.h>

#include <cmath>
#include <numbers>

namespace lacuna::test {
namespace {

/// Leave out nodes without quad, then stack layers and set the skin.
mesh::HexMesh stacked(const std::vector<Vec3>& points, const std::vector<Quad>& quads, int layers)
{
    mesh::HexMesh mesh;
    mesh.layers = layers;
    std::vector<Index> number(points.size(), -1);
    std::vector<Vec3> source;
    for (Quad quad : quads) {
        for (Index& node : quad) {
            Index& known = number[static_cast<std::size_t>(node)];
            if (known < 0) {
                known = static_cast<Index>(source.size());
                source.push_back(points[static_cast<std::size_t>(node)]);
            }
            node = known;
        }
        mesh.quads.push_back(quad);
    }
    mesh.nodes_per_layer = static_cast<Index>(source.size());
    for (int layer = 0; layer <= layers; ++layer)
        for (const Vec3& point : source) mesh.nodes.push_back(point + Vec3(0, 0, double(layer) / layers));
    for (const mesh::BoundarySide& side : mesh::boundary_sides(mesh.quads))
        mesh.rim.push_back({side.from, side.to});
    mesh.patches = {{1, {"source"}}, {2, {"target"}}, {3, {"wall:3"}}};
    mesh.source_patch.assign(mesh.quads.size(), 0);
    mesh.target_patch.assign(mesh.quads.size(), 1);
    mesh.wall_patch.assign(mesh.rim.size() * static_cast<std::size_t>(layers), 2);
    return mesh;
}

} // namespace

mesh::HexMesh block(const BlockOptions& options)
{
    std::vector<Vec3> points;
    for (int j = 0; j <= options.rows; ++j)
        for (int i = 0; i <= options.columns; ++i)
            points.emplace_back(double(i) / options.columns, double(j) / options.rows, 0);
    std::vector<Quad> quads;
    for (int j = 0; j < options.rows; ++j) {
        for (int i = 0; i < options.columns; ++i) {
            if (options.leave_out && options.leave_out(i, j)) continue;
            const Index a = j * (options.columns + 1) + i;
            quads.push_back({a, a + 1, a + options.columns + 2, a + options.columns + 1});
        }
    }
    mesh::HexMesh mesh = stacked(points, quads, options.layers);
    if (options.map)
        for (Vec3& node : mesh.nodes) node = options.map(node);
    return mesh;
}

mesh::HexMesh ring(int around, int layers)
{
    std::vector<Vec3> points;
    std::vector<Quad> quads;
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            points.emplace_back((1 + 0.5 * j) * std::cos(angle), (1 + 0.5 * j) * std::sin(angle), 0);
        }
    }
    for (Index j = 0; j < 2; ++j) {
        for (Index i = 0; i < around; ++i) {
            const Index next = (i + 1) % around;
            quads.push_back(
                {j * around + i, (j + 1) * around + i, (j + 1) * around + next, j * around + next});
        }
    }
    return stacked(points, quads, layers);
}

mesh::HexMesh with_wedges(mesh::HexMesh mesh, std::size_t every)
{
    std::vector<Quad> quads, triangles;
    for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
        const Quad& quad = mesh.quads[q];
        if (q % every != 0) {
            quads.push_back(quad);
            continue;
        }
        triangles.push_back({quad[0], quad[1], quad[2], quad[2]});
        triangles.push_back({quad[2], quad[3], quad[0], quad[0]});
    }
    quads.insert(quads.end(), triangles.begin(), triangles.end());
    mesh.quads = std::move(quads);
    mesh.source_patch.assign(mesh.quads.size(), 0);
    mesh.target_patch.assign(mesh.quads.size(), 1);
    return mesh;
}

std::vector<Hex> all_hexes(const mesh::HexMesh& mesh)
{
    std::vector<Hex> hexes;
    for (std::size_t i = 0; i < mesh.hex_count(); ++i) hexes.push_back(mesh.hex(i));
    return hexes;
}

} // namespace lacuna::test
