// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

#include <string>
#include <vector>

namespace lacuna::view {

/// "1 hex", "3 hexes"
std::string counted(std::size_t count, const std::string& what);

/// A patch of the skin as it is displayed.
struct ShownPatch {
    int tag = 0;
    std::vector<std::string> groups;
    bool made_void = false;
    std::size_t quads = 0;
};

/// The patches of a swept mesh, with their numbers of quads.
std::vector<ShownPatch> shown_patches(const mesh::HexMesh& mesh);

/// Solids as a list of cells with eight corners. Cells other than hexahedra have repeated corners, in the
/// form of `mesh::merged_corners()`.
struct ListedCells {
    std::string name;
    std::vector<Vec3> nodes;
    std::vector<Hex> cells;
    /// All nodes of cells of order 2, as `mesh::merged_nodes()`; a count of 0 for others. Empty if no cell is
    /// of order 2.
    std::vector<mesh::CellNodes> curved;
    std::vector<Index> tags;     ///< cell numbers in the file; 0 if too large
    std::vector<double> quality; ///< scaled Jacobian
    std::vector<Quad> sides;     ///< two-dimensional elements; a triangle is {a, b, c, c}
    std::vector<Index> side_patch;
};

/// The solids of a deck, one list for each region.
struct DeckCells {
    std::vector<ListedCells> regions;
    std::vector<ShownPatch> patches;
    bool second_order = false; ///< some cells are of order 2
    bool straightened = false; ///< middle nodes of some cells are not displayed
};
/// @throw InvalidInput "view.no_solids"
DeckCells listed_cells(const io::Deck& deck, const RunContext& context);

} // namespace lacuna::view
