// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/deck_middles.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/io/detail/mesh_deck.h>

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

namespace {

struct QuadHash {
    std::size_t operator()(const Quad& quad) const
    {
        return std::hash<std::uint64_t>()(edge_key(quad[0], quad[1]) * 0x9e3779b97f4a7c15ULL ^
                                          edge_key(quad[2], quad[3]));
    }
};

Quad rising(Quad quad)
{
    std::sort(quad.begin(), quad.end());
    return quad;
}

/// Quads of a shape that have a node in the middle, and which.
std::span<const std::pair<Quad, int>> centred_quads(DeckShape shape)
{
    using Centre = std::pair<Quad, int>;
    static constexpr Centre kQuad9[] = {{{0, 1, 2, 3}, 8}};
    static constexpr Centre kPyramid14[] = {{{0, 1, 2, 3}, 13}};
    static constexpr Centre kWedge18[] = {{{0, 1, 4, 3}, 15}, {{1, 2, 5, 4}, 16}, {{2, 0, 3, 5}, 17}};
    static constexpr Centre kHex27[] = {{{0, 4, 7, 3}, 20}, {{1, 2, 6, 5}, 21}, {{0, 1, 5, 4}, 22},
                                        {{3, 7, 6, 2}, 23}, {{0, 3, 2, 1}, 24}, {{4, 5, 6, 7}, 25}};
    switch (shape) {
    case DeckShape::quad9:
        return kQuad9;
    case DeckShape::pyramid14:
        return kPyramid14;
    case DeckShape::wedge18:
        return kWedge18;
    case DeckShape::hex27:
        return kHex27;
    default:
        return {};
    }
}

} // namespace

std::vector<Index> centres_of(const Deck& deck, std::span<const Quad> quads)
{
    std::unordered_map<Quad, Index, QuadHash> centre;
    std::vector<std::uint8_t> asked(deck.points.size(), 0);
    for (const Quad& quad : quads) {
        centre.emplace(rising(quad), -1);
        for (const Index point : quad) asked[index(point)] = 1;
    }
    for (const DeckBlock& block : deck.blocks) {
        const auto own = centred_quads(block.shape);
        for (std::size_t e = 0; e < (own.empty() ? 0 : block.count()); ++e) {
            const std::span<const Index> nodes = block.element(e);
            for (const auto& [corners, middle] : own) {
                Quad quad{};
                for (std::size_t k = 0; k < 4; ++k) quad[k] = nodes[index(corners[k])];
                if (nodes[index(middle)] < 0 ||
                    !std::ranges::all_of(quad, [&](Index point) { return asked[index(point)] != 0; }))
                    continue;
                const auto found = centre.find(rising(quad));
                if (found != centre.end() && found->second < 0) found->second = nodes[index(middle)];
            }
        }
    }
    std::vector<Index> found;
    found.reserve(quads.size());
    for (const Quad& quad : quads) found.push_back(centre.at(rising(quad)));
    return found;
}

std::vector<Vec3> centres_of(const Deck& deck, std::span<const std::array<Vec3, 4>> quads, double tolerance,
                             double scale)
{
    std::vector<Vec3> corners;
    for (const auto& quad : quads) corners.insert(corners.end(), quad.begin(), quad.end());
    const NodesAt at = nodes_at(deck, corners, tolerance, scale);
    std::vector<Quad> all;
    std::vector<std::size_t> of;
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (const Index a : at.at(4 * q))
            for (const Index b : at.at(4 * q + 1))
                for (const Index c : at.at(4 * q + 2))
                    for (const Index d : at.at(4 * q + 3)) {
                        all.push_back({a, b, c, d});
                        of.push_back(q);
                    }
    std::vector<Vec3> centres(quads.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    const std::vector<Index> found = centres_of(deck, all);
    for (std::size_t i = found.size(); i-- > 0;) // of several the first stays
        if (found[i] >= 0) centres[of[i]] = deck.points[index(found[i])] * scale;
    return centres;
}

namespace {

/// The nodes in the middle of quads that both have are one; either all of them have one in both, or none.
void join_centres(const Deck& deck, const mesh::HexMesh& mesh, const std::vector<bool>& matched,
                  double tolerance, double scale, std::vector<Index>& points)
{
    std::vector<Quad> quads;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = skin_nodes(mesh, i);
        if (!matched[i] || mesh::is_triangle(skin_quad(mesh, i).nodes)) continue;
        Quad& quad = quads.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) quad[k] = points[index(nodes.node[k])];
        of.push_back(i);
    }
    const std::vector<Index> found = centres_of(deck, quads);
    const bool full = mesh.order() == 2 && mesh.middles.full;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (found[q] < 0 && !full) continue;
        const std::size_t middle = full ? index(skin_nodes(mesh, of[q]).node[8]) : 0;
        const bool together = full && found[q] >= 0 &&
                              (mesh.node(middle) - deck.points[index(found[q])] * scale).norm() <= tolerance;
        if (!together) {
            std::string corners;
            for (const Index point : quads[q])
                corners += (corners.empty() ? "" : ", ") + std::to_string(deck.point_tags[index(point)]);
            throw InvalidInput(
                "io.mixed_order",
                patch_name(mesh.patches[index(skin_quad(mesh, of[q]).patch)]) + ": the quad of nodes " +
                    corners +
                    (found[q] < 0 ? " has no node in its middle in the deck, and the mesh has; sweep with "
                                    "serendipity = true"
                     : !full      ? " has a node in its middle in the deck, and the mesh has none; sweep "
                                    "with order = 2, without serendipity"
                                  : " has the node in its middle elsewhere in the deck than in the mesh"));
        }
        points[middle] = found[q];
    }
}

} // namespace

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
    join_centres(deck, mesh, matched, tolerance, scale, points);
}

} // namespace lacuna::io
