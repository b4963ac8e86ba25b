// SPDX-License-Identifier: MIT
#include <lacuna/io/detail/mesh_deck.h>

#include <lacuna/core/shared/same_corners.h>
#include <lacuna/io/cell_field.h>
#include <lacuna/io/detail/join_sets.h>

#include <algorithm>
#include <unordered_map>

namespace lacuna::io {
namespace {

/// For each quad of the skin, the Abaqus number of this face in its cell: S1 at the bottom, S2 at the top,
/// and S3 to S6 (for a wedge to S5) at the sides.
std::vector<int> sides_of_skin(const mesh::HexMesh& mesh, const std::vector<std::uint32_t>& cells)
{
    std::vector<int> sides(mesh.skin_count(), 1);
    const std::size_t quads = mesh.quads.size();
    std::fill_n(sides.begin() + static_cast<std::ptrdiff_t>(quads), quads, 2);
    for (std::size_t i = 2 * quads; i < sides.size(); ++i) {
        const Segment& side = mesh.rim[(i - 2 * quads) % mesh.rim.size()];
        const Quad& quad = mesh.quads[cells[i] % quads];
        const std::size_t corners = mesh::corner_count(quad);
        for (std::size_t k = 0; k < corners; ++k)
            if (quad[k] == side[0] && quad[(k + 1) % corners] == side[1]) sides[i] = 3 + static_cast<int>(k);
    }
    return sides;
}

} // namespace

std::pair<std::vector<std::uint32_t>, std::vector<int>> SweptParts::behind_skin() const
{
    std::vector<std::uint32_t> cells = cells_of_skin(mesh);
    std::vector<int> sides = sides_of_skin(mesh, cells);
    return {std::move(cells), std::move(sides)};
}

std::vector<Index> SweptParts::nodes_over(std::span<const Index> first) const
{
    std::vector<Index> all;
    const mesh::MiddlePlaces middle(mesh);
    for (const Index node : first) {
        for (Index level = 0; level <= mesh.layers; ++level) {
            all.push_back(level * mesh.nodes_per_layer + node);
            if (level < mesh.layers && mesh.order() > 1)
                all.push_back(static_cast<Index>(mesh::corner_count(mesh) +
                                                 middle.upright(static_cast<std::size_t>(level), node)));
        }
    }
    return all;
}

std::pair<std::vector<std::uint32_t>, std::vector<int>> TetParts::behind_skin() const
{
    std::unordered_map<Quad, std::size_t, CornerHash<4>> sides;
    for (std::size_t i = 0; i < mesh.skin.size(); ++i) sides.emplace(face_key(mesh.skin[i]), i);
    std::pair<std::vector<std::uint32_t>, std::vector<int>> behind{
        std::vector<std::uint32_t>(mesh.skin.size()), std::vector<int>(mesh.skin.size())};
    for (const OfShape& of : cells())
        for (std::size_t c = of.begin; c < of.end; ++c) {
            const mesh::CellNodes nodes = mesh::cell_nodes(mesh, c);
            int number = 0;
            for (Quad face : face_corners(of.shape)) {
                for (Index& corner : face) corner = corner < 0 ? -1 : nodes.node[index(corner)];
                ++number;
                const auto side = sides.find(rising(face));
                if (side == sides.end()) continue;
                behind.first[side->second] = static_cast<std::uint32_t>(c);
                behind.second[side->second] = number;
            }
        }
    return behind;
}

} // namespace lacuna::io
