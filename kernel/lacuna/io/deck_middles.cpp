// SPDX-License-Identifier: MIT
#include <lacuna/io/shared/deck_middles.h>

#include <lacuna/core/error.h>
#include <lacuna/io/detail/join_sets.h>
#include <lacuna/io/detail/mesh_deck.h>
#include <lacuna/io/detail/texts.h>
#include <lacuna/io/shared/solid_nodes.h>
#include <lacuna/mesh/tet_mesh.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace lacuna::io {
namespace {

/// Corners of an element, and the index of the node in the middle between them.
template <std::size_t N>
using Middle = std::pair<std::array<Index, N>, int>;

/// Sides of a shape that have a middle node.
std::vector<Middle<2>> middles_in(DeckShape shape, const Segment&)
{
    std::vector<Middle<2>> middles;
    const auto sides = side_corners(shape);
    const DeckShapeInfo& info = shape_info(shape);
    if (index(info.nodes) < index(info.corners) + sides.size()) return middles;
    for (const auto& [a, b] : sides)
        middles.push_back({{a, b}, info.corners + static_cast<int>(middles.size())});
    return middles;
}

/// Quads of a shape that have a middle node.
std::span<const Middle<4>> middles_in(DeckShape shape, const Quad&)
{
    static constexpr Middle<4> kQuad9[] = {{{0, 1, 2, 3}, 8}};
    static constexpr Middle<4> kPyramid14[] = {{{0, 1, 2, 3}, 13}};
    static constexpr Middle<4> kWedge18[] = {{{0, 1, 4, 3}, 15}, {{1, 2, 5, 4}, 16}, {{2, 0, 3, 5}, 17}};
    static constexpr Middle<4> kHex27[] = {{{0, 4, 7, 3}, 20}, {{1, 2, 6, 5}, 21}, {{0, 1, 5, 4}, 22},
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

/// The middle node that elements of the deck have between given corners, in any order; -1: none.
template <std::size_t N>
std::vector<Index> find_middles(const Deck& deck, std::span<const std::array<Index, N>> wanted)
{
    std::unordered_map<std::array<Index, N>, Index, CornerHash<N>> middle;
    std::vector<std::uint8_t> asked(deck.points.size(), 0);
    for (const auto& corners : wanted) {
        middle.emplace(rising(corners), -1);
        for (const Index point : corners) asked[index(point)] = 1;
    }
    for (const DeckBlock& block : deck.blocks) {
        const auto own = middles_in(block.shape, std::array<Index, N>());
        for (std::size_t e = 0; e < (own.empty() ? 0 : block.count()); ++e) {
            const std::span<const Index> nodes = block.element(e);
            for (const auto& [corners, place] : own) {
                std::array<Index, N> points;
                for (std::size_t k = 0; k < N; ++k) points[k] = nodes[index(corners[k])];
                if (nodes[index(place)] < 0 ||
                    !std::ranges::all_of(points, [&](Index point) { return asked[index(point)] != 0; }))
                    continue;
                const auto found = middle.find(rising(points));
                if (found != middle.end() && found->second < 0) found->second = nodes[index(place)];
            }
        }
    }
    std::vector<Index> found;
    found.reserve(wanted.size());
    for (const auto& corners : wanted) found.push_back(middle.at(rising(corners)));
    return found;
}

/// `find_middles()` for corners given as positions. Several nodes of the deck may lie at each position.
template <std::size_t N>
std::vector<Vec3> find_middles(const Deck& deck, std::span<const std::array<Vec3, N>> wanted,
                               double tolerance, double scale)
{
    std::vector<Vec3> places;
    for (const auto& corners : wanted) places.insert(places.end(), corners.begin(), corners.end());
    const NodesAt at = nodes_at(deck, places, tolerance, scale);
    std::vector<std::array<Index, N>> all;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        std::vector<std::array<Index, N>> choices(1);
        for (std::size_t k = 0; k < N; ++k) {
            std::vector<std::array<Index, N>> longer;
            for (std::array<Index, N>& choice : choices)
                for (const Index node : at.at(N * i + k)) {
                    choice[k] = node;
                    longer.push_back(choice);
                }
            choices = std::move(longer);
        }
        all.insert(all.end(), choices.begin(), choices.end());
        of.resize(all.size(), i);
    }
    std::vector<Vec3> middles(wanted.size(), Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
    const std::vector<Index> found = find_middles<N>(deck, all);
    for (std::size_t i = found.size(); i-- > 0;) // backwards, so that the first of several choices wins
        if (found[i] >= 0) middles[of[i]] = deck.points[index(found[i])] * scale;
    return middles;
}

} // namespace

mesh::CellNodes solid_nodes(const DeckBlock& block, std::size_t element)
{
    return mesh::merged_nodes(block.shape, block.element(element));
}

std::vector<Vec3> middles_between(const Deck& deck, std::span<const Vec3> from, std::span<const Vec3> to,
                                  double tolerance, double scale)
{
    std::vector<std::array<Vec3, 2>> pairs;
    for (std::size_t i = 0; i < from.size(); ++i) pairs.push_back({from[i], to[i]});
    return find_middles<2>(deck, pairs, tolerance, scale);
}

std::vector<Vec3> centres_of(const Deck& deck, std::span<const std::array<Vec3, 4>> quads, double tolerance,
                             double scale)
{
    return find_middles<4>(deck, quads, tolerance, scale);
}

namespace {

/// Match the middle nodes of quads that the deck and the mesh share. Both or neither must have one.
template <class Mesh>
void join_centres(const Deck& deck, const Mesh& mesh, const std::vector<bool>& matched, double tolerance,
                  double scale, std::vector<Index>& points)
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
    const std::vector<Index> found = find_middles<4>(deck, quads);
    const bool full = mesh.order() == 2 && mesh.middles.full;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        if (found[q] < 0 && !full) continue;
        const std::size_t middle = full ? index(skin_nodes(mesh, of[q]).node[8]) : 0;
        const bool together = full && found[q] >= 0 &&
                              (mesh.node(middle) - deck.points[index(found[q])] * scale).norm() <= tolerance;
        if (!together) {
            const NamedEntity face = entity_of(mesh.patches[index(skin_quad(mesh, of[q]).patch)]);
            std::vector<NamedEntity> corners;
            for (const Index point : quads[q])
                corners.push_back(numbered("node", deck.point_tags[index(point)]));
            if (found[q] < 0)
                throw InvalidInput(
                    Message("io.mixed_order",
                            "{}: the quad of {} has no centre node in the deck, but it has one in the mesh",
                            face, corners)
                        .remedy("sweep with serendipity = true"));
            if (!full)
                throw InvalidInput(
                    Message("io.mixed_order",
                            "{}: the quad of {} has a centre node in the deck, but none in the mesh", face,
                            corners)
                        .remedy("sweep with order = 2, without serendipity"));
            throw InvalidInput(
                Message("io.mixed_order",
                        "{}: the centre node of the quad of {} has different positions in the deck and in "
                        "the mesh",
                        face, corners)
                    .remedy("sweep a model that was loaded from this deck"));
        }
        points[middle] = found[q];
    }
}

} // namespace

/// Match the middle nodes of sides that the deck and the mesh share.
template <class Mesh>
void join_middles(const Deck& deck, const Mesh& mesh, const std::vector<bool>& matched, double tolerance,
                  double scale, std::vector<Index>& points)
{
    struct Side {
        std::size_t middle; ///< number of the mesh's middle node; 0: the mesh is of order 1
        std::size_t quad;   ///< quad of the skin
    };
    std::vector<Segment> pairs;
    std::vector<Side> sides;
    for (std::size_t i = 0; i < mesh.skin_count(); ++i) {
        const mesh::CellNodes nodes = skin_nodes(mesh, i);
        const std::size_t corners = mesh::corner_count(skin_quad(mesh, i).nodes);
        for (std::size_t k = 0; k < corners; ++k) {
            const Segment pair{points[index(nodes.node[k])], points[index(nodes.node[(k + 1) % corners])]};
            if (pair[0] < 0 || pair[1] < 0) continue;
            pairs.push_back(pair);
            sides.push_back({mesh.order() == 1 ? 0 : index(nodes.node[corners + k]), i});
        }
    }
    const std::vector<Index> found = find_middles<2>(deck, pairs);
    points.resize(mesh.node_count(), -1);
    const auto face_at = [&](std::size_t s) {
        return entity_of(mesh.patches[index(skin_quad(mesh, sides[s].quad).patch)]);
    };
    const auto node = [&](Index point) { return numbered("node", deck.point_tags[index(point)]); };
    for (std::size_t s = 0; s < found.size(); ++s) {
        if (mesh.order() == 1) {
            if (found[s] >= 0)
                throw InvalidInput(Message("io.mixed_order",
                                           "{}: the side between {} and {} has a middle node in the deck, "
                                           "but the mesh is of order 1",
                                           face_at(s), node(pairs[s][0]), node(pairs[s][1]))
                                       .remedy("sweep with order = 2, serendipity = true"));
            continue;
        }
        if (found[s] < 0) {
            if (matched[sides[s].quad])
                throw InvalidInput(Message("io.mixed_order",
                                           "{}: the side between {} and {} has no middle node in the deck, "
                                           "but the mesh is of order 2",
                                           face_at(s), node(pairs[s][0]), node(pairs[s][1]))
                                       .remedy("sweep with order = 1, or give the deck elements of order 2"));
            continue;
        }
        const Vec3 there = deck.points[index(found[s])] * scale;
        if (!((mesh.node(sides[s].middle) - there).norm() <= tolerance))
            throw InvalidInput(
                Message(
                    "io.mixed_order",
                    "{}: the middle node {} of the side between {} and {} has another position in the mesh",
                    face_at(s), node(found[s]), node(pairs[s][0]), node(pairs[s][1]))
                    .remedy("sweep a model that was loaded from this deck"));
        points[sides[s].middle] = found[s];
    }
    join_centres(deck, mesh, matched, tolerance, scale, points);
}

NamedEntity entity_of(const mesh::SkinPatch& patch)
{
    return {"face", patch.face, patch.groups.empty() ? std::string() : patch.groups.front()};
}

template void join_middles(const Deck&, const mesh::HexMesh&, const std::vector<bool>&, double, double,
                           std::vector<Index>&);
template void join_middles(const Deck&, const mesh::TetPart&, const std::vector<bool>&, double, double,
                           std::vector<Index>&);

} // namespace lacuna::io
