// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/same_corners.h>
#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// Sets of a deck that a mesh joins. Internal to this folder.
namespace lacuna::io {

/// A mesh whose nodes and cells were added to a deck, but not yet to its sets.
struct NewCells {
    const std::string& volume;    ///< name of the volume
    std::vector<DeckTag> nodes{}; ///< number of each node of the mesh
    std::vector<DeckTag> cells{}; ///< number of each cell, increasing
    /// A quad or triangle of the skin.
    struct Side {
        std::array<Vec3, 4> corners;    ///< in the deck's coordinates; a triangle repeats the last
        std::vector<DeckTag> nodes{};   ///< numbers of its nodes
        std::optional<DeckSide> side{}; ///< the cell of the mesh at the quad, and its side; none: the format
                                        ///< has no sets of sides
        std::optional<DeckTag> cell{};  ///< element of the skin at the quad; none: the skin has no elements
    };
    std::vector<Side> skin{};
};

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

/// Indices of the sets that are meant to hold all nodes or all solids of a deck: sets named "all" or "eall",
/// and those that duplicate regions. After a merge, also sets that held all of one of the merged decks.
std::vector<std::size_t> sets_of_all(const Deck& deck);

/// Add the data of a mesh to those sets of a deck that should contain it: the sets of all nodes or elements,
/// and the sets that lost members when parts were left out. The sets that lost members are treated as
/// follows:
/// - A set of all nodes or elements of the part with the volume's name gets all nodes or cells of the mesh.
///   If there is no such part, this applies to each set that contained everything left out.
/// - A surface, or a set of elements on the skin, gets the quads of the skin in place of its old sides or
///   elements. A set of nodes gets the nodes of these quads.
/// `Deck::gap` records the extended sets.
/// @param of_all  result of `sets_of_all()` before the mesh was added.
/// @param fits    returns whether a set of elements may get the cells.
void join_sets(Deck& deck, const NewCells& added, const std::vector<std::size_t>& of_all,
               const std::function<bool(const DeckSet&)>& fits);

} // namespace lacuna::io
