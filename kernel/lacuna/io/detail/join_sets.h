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

/// A mesh that was added to a deck, but not to its sets.
struct NewCells {
    const std::string& volume;    ///< its name
    std::vector<DeckTag> nodes{}; ///< number of each node of the mesh
    std::vector<DeckTag> cells{}; ///< number of each cell, increasing
    /// A quad or triangle of the skin.
    struct Side {
        std::array<Vec3, 4> corners;    ///< in the deck's coordinates; a triangle repeats the last
        std::vector<DeckTag> nodes{};   ///< numbers of its nodes
        std::optional<DeckSide> side{}; ///< none: the format has none
        std::optional<DeckTag> cell{};  ///< element there; none: the skin has none
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

/// Indices of the sets that hold all nodes or all solids of a deck, limited to sets named "all" or "eall" and
/// to those that duplicate regions. Sets for which this was true before decks were merged are included.
std::vector<std::size_t> sets_of_all(const Deck& deck);

/// Add the data of a mesh to the sets of a deck that should contain it: the sets of all nodes or elements,
/// and those that lost members when parts were left out. Of the latter
/// - a set of all nodes or elements of the part with the volume's name (if there is no such part, of
///   everything left out) gets all new ones;
/// - a surface, or a set of elements on the skin, gets the quads of the skin in place of its old sides or
///   elements; a set of nodes gets their nodes.
/// `Deck::gap` records the extended sets.
/// @param of_all  result of `sets_of_all()` before the mesh was added.
/// @param fits    whether a set of elements may get the cells.
void join_sets(Deck& deck, const NewCells& added, const std::vector<std::size_t>& of_all,
               const std::function<bool(const DeckSet&)>& fits);

} // namespace lacuna::io
