// SPDX-License-Identifier: MIT
#include <lacuna/io/deck_middles.h>

#include <lacuna/core/edge_key.h>
#include <lacuna/core/error.h>
#include <lacuna/io/detail/mesh_deck.h>
#include <lacuna/io/detail/sections.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace lacuna::io {
namespace {

std::string patch_name(const mesh::SkinPatch& patch)
{
    return patch.groups.empty() ? "face " + std::to_string(patch.face) : patch.groups.front();
}

} // namespace

std::vector<Index> middles_between(const Deck& deck, std::span<const Segment> pairs)
{
    std::unordered_map<std::uint64_t, Index> middle;
    std::vector<std::uint8_t> asked(deck.points.size(), 0);
    for (const Segment& pair : pairs) {
        middle.emplace(edge_key(pair[0], pair[1]), -1);
        for (const Index point : pair) asked[index(point)] = 1;
    }
    for (const DeckBlock& block : deck.blocks) {
        const auto sides = side_corners(block.shape);
        const auto corners = index(shape_info(block.shape).corners);
        if (index(shape_info(block.shape).nodes) < corners + sides.size()) continue;
        for (std::size_t e = 0; e < block.count(); ++e) {
            const std::span<const Index> nodes = block.element(e);
            for (std::size_t k = 0; k < sides.size(); ++k) {
                const Index a = nodes[index(sides[k].first)], b = nodes[index(sides[k].second)];
                if (asked[index(a)] == 0 || asked[index(b)] == 0 || nodes[corners + k] < 0) continue;
                const auto found = middle.find(edge_key(a, b));
                if (found != middle.end() && found->second < 0) found->second = nodes[corners + k];
            }
        }
    }
    std::vector<Index> found;
    found.reserve(pairs.size());
    for (const Segment& pair : pairs) found.push_back(middle.at(edge_key(pair[0], pair[1])));
    return found;
}

std::vector<Vec3> middles_between(const Deck& deck, std::span<const Vec3> from, std::span<const Vec3> to,
                                  double tolerance, double scale)
{
    const NodesAt first = nodes_at(deck, from, tolerance, scale),
                  second = nodes_at(deck, to, tolerance, scale);
    std::vector<Segment> pairs;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < from.size(); ++i)
        for (const Index a : first.at(i))
            for (const Index b : second.at(i)) {
                pairs.push_back({a, b});
                of.push_back(i);
            }
    std::vector<Vec3> middles(from.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    const std::vector<Index> found = middles_between(deck, pairs);
    for (std::size_t i = found.size(); i-- > 0;) // of several the first stays
        if (found[i] >= 0) middles[of[i]] = deck.points[index(found[i])] * scale;
    return middles;
}

void join_middles(const Deck& deck, const mesh::HexMesh& mesh, const std::vector<bool>& matched,
                  double tolerance, double scale, std::vector<Index>& points)
{
    struct Side {
        std::size_t middle; ///< number of the mesh's middle node; 0: of order 1
        std::size_t quad;   ///< of the skin
    };
    std::vector<Segment> pairs;
    std::vector<Side> sides;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = skin_nodes(mesh, i);
        for (std::size_t k = 0; k < 4; ++k) {
            const Segment pair{points[index(nodes.node[k])], points[index(nodes.node[(k + 1) % 4])]};
            if (pair[0] < 0 || pair[1] < 0) continue;
            pairs.push_back(pair);
            sides.push_back({mesh.order() == 1 ? 0 : index(nodes.node[4 + k]), i});
        }
    }
    const std::vector<Index> found = middles_between(deck, pairs);
    points.resize(mesh.node_count(), -1);
    const auto refuse = [&](std::size_t s, const std::string& why) {
        const mesh::SkinPatch& patch = mesh.patches[index(skin_quad(mesh, sides[s].quad).patch)];
        throw InvalidInput("io.mixed_order",
                           patch_name(patch) + ": the side between nodes " +
                               std::to_string(deck.point_tags[index(pairs[s][0])]) + " and " +
                               std::to_string(deck.point_tags[index(pairs[s][1])]) + " " + why);
    };
    for (std::size_t s = 0; s < found.size(); ++s) {
        if (mesh.order() == 1) {
            if (found[s] >= 0)
                refuse(s, "has a middle node in the deck, and the mesh is of order 1: the two would not "
                          "conform. Sweep with order = 2, serendipity = true");
            continue;
        }
        if (found[s] < 0) {
            if (matched[sides[s].quad])
                refuse(s, "has no middle node in the deck, and the mesh is of order 2: the two would not "
                          "conform. Sweep with order = 1, or give the deck elements of order 2");
            continue;
        }
        const Vec3 there = deck.points[index(found[s])] * scale;
        if (!((mesh.node(sides[s].middle) - there).norm() <= tolerance))
            refuse(s, "has its middle node " + std::to_string(deck.point_tags[index(found[s])]) +
                          " elsewhere in the deck than in the mesh");
        points[sides[s].middle] = found[s];
    }
}

} // namespace lacuna::io
