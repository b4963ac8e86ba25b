// SPDX-License-Identifier: MIT
#include "support/prove_cells.h"

#include <lacuna/quality/detail/findings.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace lacuna::test {

using namespace quality;

namespace {

constexpr Index kGivenSkin = -1; ///< owner of a side from the given skin

/// A side of a cell, with a key for sorting: its lowest node, the opposite one, and the other two in order.
struct CellSide {
    std::array<Index, 4> key;
    Quad nodes;
    Index owner;
    bool triangle = false;
};

bool operator<(const CellSide& a, const CellSide& b)
{
    return std::tie(a.key, a.owner) < std::tie(b.key, b.owner);
}

/// A quad rotated to start at its lowest node; same side, same direction.
Quad turned(const Quad& quad)
{
    const auto lowest = static_cast<std::size_t>(std::min_element(quad.begin(), quad.end()) - quad.begin());
    return {quad[lowest], quad[(lowest + 1) % 4], quad[(lowest + 2) % 4], quad[(lowest + 3) % 4]};
}

/// The key of a triangle: its lowest node and the other two, of which the higher is repeated.
CellSide make_triangle(const Quad& quad, Index owner)
{
    std::array<Index, 3> nodes{quad[0], quad[1], quad[2]};
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end()), nodes.end());
    const auto [low, high] = std::minmax(nodes[1], nodes[2]);
    return {{nodes[0], low, high, high}, {nodes[0], nodes[1], nodes[2], nodes[2]}, owner, true};
}

CellSide make_side(const Quad& quad, Index owner)
{
    CellSide side{{quad[0], quad[1], quad[2], quad[3]}, turned(quad), owner};
    std::sort(side.key.begin(), side.key.end());
    return side;
}

std::string name_of(std::span<const Vec3> nodes, Index node)
{
    const NodeName name = node_name(nodes, node, 0);
    return formatted("{} ({})", name.node, name.place);
}

std::string side_name(std::span<const Vec3> nodes, const CellSide& side)
{
    return formatted("the side of cell {} between {} and {}", side.owner + 1, name_of(nodes, side.nodes[0]),
                     name_of(nodes, side.nodes[2]));
}

Found check_corners(std::span<const Vec3> nodes, std::span<const Hex> hexes, std::span<const Quad> skin)
{
    if (hexes.empty()) return Finding(Fault::empty, "the mesh has no cells");
    std::vector<char> used(nodes.size(), 0);
    const auto known = [&](Index node) { return node >= 0 && static_cast<std::size_t>(node) < nodes.size(); };
    for (std::size_t h = 0; h < hexes.size(); ++h) {
        for (const Index node : hexes[h]) {
            if (!known(node))
                return Finding(Fault::unknown_node, "cell {} has node number {} of {}", h + 1,
                               std::int64_t(node) + 1, nodes.size());
            used[static_cast<std::size_t>(node)] = 1;
        }
    }
    for (const Quad& quad : skin)
        if (!std::all_of(quad.begin(), quad.end(), known))
            return Finding(Fault::unknown_node, "a quad of the given skin has a node number out of range");
    const auto unused = std::find(used.begin(), used.end(), 0);
    if (unused != used.end())
        return Finding(Fault::unused_node, "{} belongs to no cell",
                       name_of(nodes, static_cast<Index>(unused - used.begin())));
    return std::nullopt;
}

/// Sides of all cells and of the given skin, grouped by their lowest node.
std::vector<CellSide> sorted_sides(std::span<const Vec3> nodes, std::span<const Hex> hexes,
                                   std::span<const Quad> skin)
{
    std::vector<std::size_t> start(nodes.size() + 1, 0);
    const auto for_each_quad = [&](const auto& body) {
        for (std::size_t h = 0; h < hexes.size(); ++h) {
            if (mesh::is_wedge(hexes[h])) {
                const mesh::Wedge w = mesh::wedge_of(hexes[h]);
                const auto owner = static_cast<Index>(h);
                body(Quad{w[1], w[0], w[2], w[2]}, owner, true);
                body(Quad{w[3], w[4], w[5], w[5]}, owner, true);
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::size_t next = (k + 1) % 3;
                    body(Quad{w[k], w[next], w[3 + next], w[3 + k]}, owner, false);
                }
                continue;
            }
            for (const Quad& s : mesh::kHexSides) {
                const auto corner = [&](std::size_t i) { return hexes[h][static_cast<std::size_t>(s[i])]; };
                body(Quad{corner(0), corner(1), corner(2), corner(3)}, static_cast<Index>(h), false);
            }
        }
        for (const Quad& quad : skin) body(quad, kGivenSkin, mesh::is_triangle(quad));
    };
    for_each_quad([&](const Quad& quad, Index, bool) {
        ++start[static_cast<std::size_t>(*std::min_element(quad.begin(), quad.end())) + 1];
    });
    for (std::size_t n = 1; n < start.size(); ++n) start[n] += start[n - 1];
    std::vector<CellSide> sides(start.back());
    std::vector<std::size_t> next(start.begin(), start.end() - 1);
    for_each_quad([&](const Quad& quad, Index owner, bool triangle) {
        const CellSide side = triangle ? make_triangle(quad, owner) : make_side(quad, owner);
        sides[next[static_cast<std::size_t>(side.key[0])]++] = side;
    });
    for (std::size_t n = 0; n + 1 < start.size(); ++n)
        std::sort(sides.begin() + static_cast<std::ptrdiff_t>(start[n]),
                  sides.begin() + static_cast<std::ptrdiff_t>(start[n + 1]));
    return sides;
}

/// Check one side, given all its users: first the given skin, then the cells.
Found check_side(std::span<const Vec3> nodes, std::span<const CellSide> users, bool skin_given)
{
    const auto given = static_cast<std::size_t>(
        std::count_if(users.begin(), users.end(), [](const CellSide& s) { return s.owner == kGivenSkin; }));
    const std::span<const CellSide> cells = users.subspan(given);
    const CellSide& any = users.back();
    const auto& key = any.key;
    const auto end = any.triangle ? key.end() - 1 : key.end();
    if (std::adjacent_find(key.begin(), end) != end)
        return Finding(Fault::collapsed_side, "{} has the same node twice", side_name(nodes, any));
    if (cells.size() > 2)
        return Finding(Fault::not_conformal, "{} is shared by {} cells", side_name(nodes, any), cells.size());
    if (cells.size() == 2) {
        const Quad& a = cells[0].nodes;
        const Quad& b = cells[1].nodes;
        const bool alike = any.triangle ? a[1] == b[2] && a[2] == b[1]
                                        : a[1] == b[3] && a[2] == b[2] && a[3] == b[1];
        if (!alike)
            return Finding(Fault::not_conformal, "{} does not match the side of cell {}",
                           side_name(nodes, any), cells[0].owner + 1);
    }
    const std::size_t expected = cells.size() == 1 ? 1 : 0;
    if (skin_given && given != expected)
        return Finding(Fault::skin_differs,
                       "the quad between {} and {} is listed {} times in the given skin; expected {}",
                       name_of(nodes, any.nodes[0]), name_of(nodes, any.nodes[2]), given, expected);
    return std::nullopt;
}

/// Check that every edge of the skin joins two of its quads, in opposite directions.
Found check_skin_edges(std::span<const Vec3> nodes, const std::vector<Quad>& skin)
{
    struct Use {
        Index low, high;
        bool rising;
    };
    std::vector<Use> uses;
    uses.reserve(4 * skin.size());
    for (const Quad& quad : skin) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (!mesh::is_side(quad, i)) continue;
            const Index a = quad[i];
            const Index b = quad[(i + 1) % 4];
            uses.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
        return std::tie(a.low, a.high, a.rising) < std::tie(b.low, b.high, b.rising);
    });
    for (std::size_t i = 0; i < uses.size();) {
        std::size_t j = i;
        while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high) ++j;
        if (j - i != 2 || uses[i].rising == uses[i + 1].rising)
            return Finding(Fault::open_skin,
                           "the edge of the skin from {} to {} is used by {} quads; expected two",
                           name_of(nodes, uses[i].low), name_of(nodes, uses[i].high), j - i);
        i = j;
    }
    return std::nullopt;
}

} // namespace

Proof prove_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes, std::span<const Quad> skin,
                  double min_scaled_jacobian, const RunContext& context)
{
    Proof proof;
    const auto found = [&](Found finding) {
        proof.finding = std::move(finding);
        return proof.finding.has_value();
    };
    if (found(check_corners(nodes, hexes, skin))) return proof;
    proof.quality = measure_cells(nodes, hexes, context);
    if (found(check_quality(proof.quality, min_scaled_jacobian, 0))) return proof;

    const std::vector<CellSide> sides = sorted_sides(nodes, hexes, skin);
    std::vector<Quad> found_skin;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t j = i, cells = 0;
        for (; j < sides.size() && sides[j].key == sides[i].key; ++j)
            cells += sides[j].owner != kGivenSkin ? 1 : 0;
        if (found(check_side(nodes, std::span(sides).subspan(i, j - i), !skin.empty()))) return proof;
        if (cells == 1) found_skin.push_back(sides[j - 1].nodes); // the given skin is sorted first
        i = j;
    }
    if (!found(check_skin_edges(nodes, found_skin))) found(check_nodes(nodes, 0, context));
    return proof;
}

} // namespace lacuna::test
