// SPDX-License-Identifier: MIT
#include <lacuna/sweep/shared/shared_middles.h>

#include <lacuna/mesh/second_order.h>
#include <lacuna/sweep/detail/place_order.h>
#include <lacuna/sweep/detail/shared_quads.h>

#include <algorithm>

namespace lacuna::sweep {

/// Add the middles of a quad or triangle of the skin. @param wanted  called with the ends of a side; returns
/// whether its middle is added
template <class Mesh, class Wanted>
bool SharedMiddles::add_quad(const Mesh& mesh, std::size_t i, const Wanted& wanted)
{
    bool agrees = true;
    const auto add = [&](Places& places, const Key& key, const Vec3& middle) {
        agrees = places.try_emplace(key, middle).first->second == middle && agrees;
    };
    const mesh::CellNodes nodes = mesh::skin_nodes(mesh, i);
    const std::size_t count = mesh::corner_count(mesh::skin_quad(mesh, i).nodes);
    std::array<Vec3, 4> corners;
    for (std::size_t k = 0; k < count; ++k) corners[k] = mesh.nodes[index(nodes.node[k])];
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t next = (k + 1) % count;
        if (!wanted(nodes.node[k], nodes.node[next])) continue;
        add(sides_, key_of(corners[k], corners[next]), mesh.node(index(nodes.node[count + k])));
    }
    if (nodes.count == 9 && wanted(-1, -1)) add(centres_, key_of(corners), mesh.node(index(nodes.node[8])));
    return agrees;
}

bool SharedMiddles::add(const mesh::HexMesh& mesh, const std::function<bool(Index)>& wanted)
{
    bool agrees = true;
    std::vector<bool> on_border(mesh.nodes.size(), false);
    for (const Segment& side : patch_borders(mesh)) {
        for (const Index n : side) on_border[index(n)] = true;
    }
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const bool shared = wanted(mesh::skin_quad(mesh, i).patch);
        const auto is_wanted = [&](Index a, Index b) {
            return shared || (a >= 0 && on_border[index(a)] && on_border[index(b)]);
        };
        agrees = add_quad(mesh, i, is_wanted) && agrees;
    }
    return agrees;
}

bool SharedMiddles::add(const mesh::TetPart& mesh)
{
    bool agrees = true;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i)
        agrees = add_quad(mesh, i, [](Index, Index) { return true; }) && agrees;
    return agrees;
}

SharedMiddles::Key SharedMiddles::key_of(const Vec3& a, const Vec3& b)
{
    const Vec3 &low = before(b, a) ? b : a, &high = before(b, a) ? a : b;
    return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

/// The key of a quad: its smallest corner and the opposite corner.
SharedMiddles::Key SharedMiddles::key_of(const std::array<Vec3, 4>& corners)
{
    const auto least = std::ranges::min_element(corners, before);
    const auto at = static_cast<std::size_t>(least - corners.begin());
    return key_of(corners[at], corners[(at + 2) % 4]);
}

std::optional<Vec3> SharedMiddles::find(const Places& places, const Key& key)
{
    const auto found = places.find(key);
    return found == places.end() ? std::nullopt : std::optional(found->second);
}

} // namespace lacuna::sweep
