// SPDX-License-Identifier: MIT
#include "support/mixed_cells.h"

#include <lacuna/mesh/hex_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

namespace lacuna::test {

mesh::TetMesh mixed_cells(int n, unsigned seed)
{
    mesh::TetMesh made;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> move(-0.15, 0.15);
    std::map<std::array<int, 3>, Index> at; // by twice the place
    const auto node = [&](int x, int y, int z) {
        const auto [found, fresh] = at.try_emplace({x, y, z}, static_cast<Index>(made.nodes.size()));
        if (fresh) {
            const std::array<int, 3> place{x, y, z}, most{2 * n, 2 * n, 4};
            Vec3& point = made.nodes.emplace_back();
            for (std::size_t d = 0; d < 3; ++d) {
                const double by = move(random);
                point[static_cast<int>(d)] = place[d] / 2.0 + (place[d] == 0 || place[d] == most[d] ? 0 : by);
            }
        }
        return found->second;
    };
    const auto cube = [&](int i, int j, int k) {
        Hex corners;
        for (int c = 0; c < 8; ++c)
            corners[index(c)] = node(2 * (i + ((c + 1) / 2) % 2), 2 * (j + (c / 2) % 2), 2 * (k + c / 4));
        return corners;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Hex low = cube(i, j, 0), high = cube(i, j, 1);
            const bool wedges = i == 0;
            if (wedges) { // the diagonal starts at the lowest node of the top, as in the tetrahedra above
                const auto first = static_cast<std::size_t>(std::min_element(low.begin() + 4, low.end()) -
                                                            low.begin() - 4);
                const auto corner = [&](std::size_t k) { return (first + k) % 4; };
                for (const auto& [b, c] : {std::pair(1, 2), std::pair(2, 3)}) {
                    const std::array<std::size_t, 3> t{corner(0), corner(index(b)), corner(index(c))};
                    made.cells.push_back(mesh::hex_of(
                        {low[t[0]], low[t[1]], low[t[2]], low[4 + t[0]], low[4 + t[1]], low[4 + t[2]]}));
                }
            } else {
                made.cells.push_back(low);
            }
            const Index middle = node(2 * i + 1, 2 * j + 1, 3);
            for (std::size_t s = 0; s < 6; ++s) {
                Quad q;
                for (std::size_t k = 0; k < 4; ++k) q[3 - k] = high[index(mesh::kHexSides[s][k])];
                if (s == 0 && !wedges) {
                    made.cells.push_back({q[0], q[1], q[2], q[3], middle, middle, middle, middle});
                    continue;
                }
                std::rotate(q.begin(), std::min_element(q.begin(), q.end()), q.end());
                for (const auto& [b, c] : {std::pair(q[1], q[2]), std::pair(q[2], q[3])})
                    made.cells.push_back({q[0], b, c, c, middle, middle, middle, middle});
            }
        }
    return made;
}

io::Deck mixed_deck(int n, int order, double bend)
{
    const mesh::TetMesh cells = mixed_cells(n);
    io::Deck deck;
    deck.format = io::DeckFormat::vtu;
    deck.points = cells.nodes;
    deck.regions.push_back({4, "solid", ""});
    std::map<Segment, Index> middles;
    const auto middle = [&](Index a, Index b) {
        const auto [found, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                        static_cast<Index>(deck.points.size()));
        if (fresh) {
            const Vec3 p = (cells.nodes[index(a)] + cells.nodes[index(b)]) / 2;
            deck.points.push_back(p +
                                  bend * Vec3(std::sin(5 * p.y()), std::cos(4 * p.z()), std::sin(6 * p.x())));
        }
        return found->second;
    };
    std::map<int, io::DeckBlock> blocks; // by the number of corners
    io::DeckTag tag = 11;
    for (const Hex& cell : cells.cells) {
        const mesh::CellNodes nodes = mesh::distinct_corners(cell);
        std::vector<Index> own(nodes.begin(), nodes.end());
        const int corners = static_cast<int>(own.size());
        io::DeckShape shape = *mesh::find_shape(3, corners, corners);
        if (order == 2) {
            const auto sides = mesh::side_corners(shape);
            for (const auto& [a, b] : sides) own.push_back(middle(own[index(a)], own[index(b)]));
            shape = *mesh::find_shape(3, corners, static_cast<int>(own.size()));
        }
        io::DeckBlock& block = blocks[corners];
        block.shape = shape;
        block.nodes.insert(block.nodes.end(), own.begin(), own.end());
        block.tags.push_back(tag += 3);
        block.regions.push_back(0);
    }
    for (auto& [corners, block] : blocks) deck.blocks.push_back(std::move(block));
    for (std::size_t p = 0; p < deck.points.size(); ++p)
        deck.point_tags.push_back(2 * static_cast<io::DeckTag>(p) + 5);
    return deck;
}

} // namespace lacuna::test
