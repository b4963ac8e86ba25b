// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/compare_face.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/sweep/detail/middle_skin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace lacuna::sweep {

namespace {

void set_mean_sides(Skin& skin)
{
    for (SkinOfFace& face : skin.faces)
        for (const double side : face.side) face.mean_side += side / static_cast<double>(face.side.size());
}

/// The quads of a mesh's skin by face.
/// @param points   the nodes of the skin
/// @param quads    number of quads of the skin that precede its first triangle, if the mesh is of order 2
/// @param at       returns the index in `points` of a node of the mesh
/// @param whole    whether, at order 2, the allowed distance at half a side follows the whole side's length
template <class Mesh, class At>
Skin skin_of(const Mesh& mesh, std::vector<Vec3> points, std::size_t quads, const At& at, bool whole,
             const std::vector<FaceId>& faces, std::size_t face_count, const RunContext& context)
{
    Skin skin{std::move(points), std::vector<SkinOfFace>(face_count)};
    for (std::size_t f = 0; f < face_count; ++f) skin.faces[f].face = FaceId(f);
    const bool curved = mesh.order() > 1;
    // Append the centres of quads that are not nodes of the mesh.
    const std::size_t known = skin.points.size();
    if (curved && !mesh.middles.full) skin.points.resize(known + quads);
    struct Numbered {
        Quad nodes{};
        double side = 0; ///< the longest
    };
    const std::size_t parts = curved ? 4 : 1;
    std::vector<Numbered> all(parts * mesh.skin_count());
    parallel_each(context, mesh.skin_count(), kPerTask, [&](std::size_t i) {
        const mesh::CellNodes nodes = mesh::skin_nodes(mesh, i);
        const std::size_t count = mesh::corner_count(mesh::skin_quad(mesh, i).nodes);
        std::array<Index, 9> own{};
        for (std::size_t k = 0; k < std::max<std::size_t>(nodes.count, 4); ++k) own[k] = at(nodes.node[k]);
        const auto middle = [&](std::size_t k) { return own[count + k % count]; };
        if (count == 4 && nodes.count == 8) {
            std::array<Vec3, 4> sides, corners;
            for (std::size_t k = 0; k < 4; ++k) {
                corners[k] = skin.points[index(own[k])];
                sides[k] = skin.points[index(middle(k))];
            }
            own[8] = static_cast<Index>(known + i);
            skin.points[known + i] = middle_of_quad(sides, corners);
        }
        const auto longest = [&](const Quad& quad) {
            double squared = 0;
            for (std::size_t k = 0; k < 4; ++k)
                squared = std::max(
                    squared,
                    (skin.points[index(quad[(k + 1) % 4])] - skin.points[index(quad[k])]).squaredNorm());
            return std::sqrt(squared);
        };
        const Quad corners{own[0], own[1], own[2], own[count == 4 ? 3 : 2]};
        for (std::size_t j = 0; j < parts; ++j) {
            Quad part = corners;
            if (curved && j < count) {
                const Index before = middle(j + count - 1);
                part = {own[j], middle(j), count == 4 ? own[8] : before, before};
            } else if (curved) {
                part = {middle(0), middle(1), middle(2), middle(2)};
            }
            all[parts * i + j] = {part, longest(whole ? corners : part)};
        }
    });
    for (std::size_t i = 0; i < all.size(); ++i) {
        SkinOfFace& face = skin.faces[faces[index(mesh::skin_quad(mesh, i / parts).patch)].index()];
        face.quads.push_back(all[i].nodes);
        face.side.push_back(all[i].side);
        face.item.push_back(i / parts);
    }
    set_mean_sides(skin);
    return skin;
}

} // namespace

Skin skin_of(const mesh::SkinNodes& nodes, const std::vector<FaceId>& faces, std::size_t face_count,
             const RunContext& context)
{
    const mesh::HexMesh& mesh = nodes.mesh;
    // Number the nodes of the first and the last layer and the rim nodes in between, in the mesh's order, and
    // then the middle nodes.
    std::vector<Index> known;
    const Index row = mesh.nodes_per_layer;
    std::set<Index> rim;
    for (const Segment& side : mesh.rim) rim.insert(side.begin(), side.end());
    for (Index n = 0; n < row; ++n) known.push_back(n);
    for (Index layer = 1; layer < mesh.layers; ++layer) {
        for (const Index n : rim) known.push_back(layer * row + n);
    }
    for (Index n = 0; n < row; ++n) known.push_back(mesh.layers * row + n);
    const auto corners = static_cast<std::ptrdiff_t>(known.size());
    for (std::size_t i = 0; mesh.order() > 1 && i < mesh.skin_count(); ++i) {
        const mesh::CellNodes quad = mesh::skin_nodes(mesh, i);
        known.insert(known.end(), quad.begin() + 4, quad.end());
    }
    std::sort(known.begin() + corners, known.end());
    known.erase(std::unique(known.begin() + corners, known.end()), known.end());
    std::vector<Vec3> points(known.size());
    parallel_each(context, known.size(), kPerTask, [&](std::size_t i) { points[i] = nodes[known[i]]; });
    const auto at = [&](Index node) {
        return static_cast<Index>(std::ranges::lower_bound(known, node) - known.begin());
    };
    return skin_of(mesh, std::move(points), mesh.skin_count(), at, false, faces, face_count, context);
}

Skin skin_of(const mesh::TetPart& mesh, const std::vector<FaceId>& faces, std::size_t face_count)
{
    std::vector<Vec3> points = mesh.nodes;
    points.insert(points.end(), mesh.middles.nodes.begin(), mesh.middles.nodes.end());
    return skin_of(mesh, std::move(points), mesh.skin_quads, [](Index node) { return node; }, true, faces,
                   face_count, {});
}

} // namespace lacuna::sweep
