// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// Sets of a deck that a mesh joins. Internal to this folder.
namespace lacuna::io {

/// A mesh that is in a deck now, whose sets do not have it yet.
struct NewCells {
    const mesh::HexMesh& mesh;
    double scale = 1;              ///< of the mesh's coordinates to the deck's
    const std::string& volume;     ///< its name
    std::vector<DeckTag> nodes{};  ///< number of each node of the mesh
    std::vector<DeckTag> cells{};  ///< of each cell, rising
    std::vector<DeckSide> sides{}; ///< of each quad of the skin; empty: the format has none
    std::vector<DeckTag> skin{};   ///< of each quad of the skin as an element; empty: they are none
};

/// Nodes rising: sides and faces are known by them.
template <std::size_t N>
std::array<Index, N> rising(std::array<Index, N> nodes)
{
    std::ranges::sort(nodes);
    return nodes;
}
template <std::size_t N>
struct CornerHash {
    std::size_t operator()(const std::array<Index, N>& nodes) const
    {
        std::uint64_t all = 0;
        for (const Index node : nodes)
            all = (all ^ static_cast<std::uint64_t>(static_cast<std::uint32_t>(node))) *
                  0x9e3779b97f4a7c15ULL;
        return static_cast<std::size_t>(all ^ (all >> 32));
    }
};

/// Nodes of a face of a solid, of its place in `face_corners()`, and of a shell: rising.
inline Quad face_key(const DeckBlock& block, std::size_t e, Quad face)
{
    for (Index& k : face) k = k < 0 ? -1 : block.element(e)[index(k)];
    return rising(face);
}
inline Quad shell_key(const DeckBlock& block, std::size_t e)
{
    return face_key(block, e, {0, 1, 2, shape_info(block.shape).corners == 4 ? 3 : -1});
}

/// Places of the sets that hold all nodes of a deck, or all solids: of these sets those that are called "all"
/// or "eall", or are a second name of what regions hold. Also those that did before decks were merged.
std::vector<std::size_t> sets_of_all(const Deck& deck);

/// Put what a mesh has into the sets of a deck that are to hold it: those of all, and those that held some of
/// what was left out of the deck. Of these
/// - a set of all nodes or elements of the part that has the volume's name, else of all that was left out,
///   gets all new ones;
/// - a surface, or a set of elements on the skin, gets the quads of the skin that lie where its sides or
///   elements lay, a set of nodes their nodes.
/// `Deck::gap` lists the sets that got some.
/// @param of_all  as `sets_of_all()` found them before.
/// @param fits    whether a set of elements may have the cells.
void join_sets(Deck& deck, const NewCells& added, const std::vector<std::size_t>& of_all,
               const std::function<bool(const DeckSet&)>& fits);

} // namespace lacuna::io
