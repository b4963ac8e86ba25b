// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/assembly_nodes.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/core/error.h>
#include <lacuna/sweep/detail/place_order.h>
#include <lacuna/sweep/detail/words.h>
#include <lacuna/topology/side_points.h>

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// A node of a part.
struct PartNode {
    std::size_t part;
    Index node;
    friend auto operator<=>(const PartNode&, const PartNode&) = default;
};

/// Each node but the first in its place, with that first one.
std::vector<std::pair<PartNode, PartNode>> in_same_places(const SweptAssembly& assembly,
                                                          std::vector<PartNode> nodes)
{
    const auto place = [&](const PartNode& node) -> const Vec3& {
        return assembly.parts[node.part].mesh.node(index(node.node));
    };
    std::sort(nodes.begin(), nodes.end(), [&](const PartNode& a, const PartNode& b) {
        if (before(place(a), place(b))) return true;
        if (before(place(b), place(a))) return false;
        return a < b;
    });
    std::vector<std::pair<PartNode, PartNode>> same;
    for (std::size_t i = 0, first = 0; i < nodes.size(); ++i) {
        if (i == 0 || before(place(nodes[first]), place(nodes[i]))) first = i;
        if (first != i) same.emplace_back(nodes[i], nodes[first]);
    }
    return same;
}

/// Middle nodes of the skin.
void add_middles(const mesh::HexMesh& mesh, std::size_t part, std::vector<PartNode>& nodes)
{
    std::vector<bool> known(mesh.middles.nodes.size(), false);
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        for (const Index n : mesh::skin_nodes(mesh, i).all()) {
            if (index(n) < mesh.nodes.size() || known[index(n) - mesh.nodes.size()]) continue;
            known[index(n) - mesh.nodes.size()] = true;
            nodes.push_back({part, n});
        }
    }
}

} // namespace

void number_nodes(SweptAssembly& assembly, std::span<const std::vector<SharedNodes>> shared)
{
    std::vector<PartNode> by_place;
    std::vector<std::vector<bool>> on_border(assembly.parts.size());
    for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
        const mesh::HexMesh& mesh = assembly.parts[p].mesh;
        on_border[p].resize(mesh.nodes.size(), false);
        for (const Segment& side : patch_borders(mesh)) {
            for (const Index n : side) {
                if (!on_border[p][index(n)]) by_place.push_back({p, n});
                on_border[p][index(n)] = true;
            }
        }
        if (mesh.order() > 1) add_middles(mesh, p, by_place);
    }
    std::vector<std::pair<PartNode, PartNode>> same = in_same_places(assembly, std::move(by_place));
    for (const std::vector<SharedNodes>& faces : shared) {
        for (const SharedNodes& face : faces) {
            for (const NodePair& pair : face.pairs) {
                PartNode a{face.own, pair.own}, b{face.other, pair.other};
                if (on_border[a.part][index(a.node)] && on_border[b.part][index(b.node)]) continue;
                if (a < b) std::swap(a, b);
                same.emplace_back(a, b);
            }
        }
    }
    std::sort(same.begin(), same.end());
    Index next = 0;
    auto twin = same.begin();
    assembly.number.resize(assembly.parts.size());
    for (std::size_t p = 0; p < assembly.parts.size(); ++p) {
        std::vector<Index>& number = assembly.number[p];
        number.resize(assembly.parts[p].mesh.node_count());
        for (std::size_t n = 0; n < number.size(); ++n) {
            if (twin != same.end() && twin->first == PartNode{p, static_cast<Index>(n)}) {
                number[n] = assembly.number[twin->second.part][index(twin->second.node)];
                ++twin;
            } else {
                number[n] = next++;
            }
        }
    }
    assembly.nodes = index(next);
}

void check_no_hanging_nodes(const SweptAssembly& assembly, std::span<const AssemblyMember> members)
{
    struct EdgeSide {
        std::size_t part;
        Segment nodes;
    };
    // Each place once, by its number in the whole.
    std::vector<EdgeSide> sides;
    std::vector<std::array<Vec3, 2>> segments;
    std::vector<std::pair<std::size_t, Index>> at;
    std::vector<Vec3> points;
    std::unordered_set<std::uint64_t> known_sides;
    std::vector<bool> known(assembly.nodes, false);
    double tolerance = 0;
    for (std::size_t p = 0; p < members.size(); ++p) {
        tolerance = std::max(tolerance, members[p].volume->model.tolerance);
        const mesh::HexMesh& mesh = assembly.parts[p].mesh;
        const std::vector<Index>& number = assembly.number[p];
        for (const Segment& side : patch_borders(mesh)) {
            if (!known_sides.insert(edge_key(number[index(side[0])], number[index(side[1])])).second)
                continue;
            sides.push_back({p, side});
            segments.push_back({mesh.nodes[index(side[0])], mesh.nodes[index(side[1])]});
            for (const Index n : side) {
                if (known[index(number[index(n)])]) continue;
                known[index(number[index(n)])] = true;
                at.emplace_back(p, n);
                points.push_back(mesh.nodes[index(n)]);
            }
        }
    }
    for (const NearSegment& near : near_segments(points, segments, tolerance)) {
        const auto& [part, node] = at[index(near.point)];
        const EdgeSide& side = sides[index(near.segment)];
        if (part == side.part) continue;
        const Index number = assembly.number[part][index(node)];
        const Segment ends{assembly.number[side.part][index(side.nodes[0])],
                           assembly.number[side.part][index(side.nodes[1])]};
        if (number == ends[0] || number == ends[1]) continue;
        const Vec3& p = points[index(near.point)];
        const auto& [a, b] = segments[index(near.segment)];
        const double f = fraction_along(p, a, b);
        if ((p - ((1 - f) * a + f * b)).norm() > tolerance) continue;
        std::string why =
            "they touch along an edge and share no face there; give them the same size along it";
        for (const NearMiss& miss : assembly.near_misses) {
            if (miss.a == std::min(part, side.part) && miss.b == std::max(part, side.part))
                why = miss.message;
        }
        throw NotSweepable("assembly.hanging_node", members[part].region + " has a node at " +
                                                        place_in_short(p) + ", where " +
                                                        members[side.part].region + " has none: " + why);
    }
}

} // namespace lacuna::sweep
