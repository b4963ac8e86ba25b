// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/mesh/hex_mesh.h>

#include <string>
#include <vector>

namespace lacuna::view {

/// A part of the skin as it is shown.
struct ShownPatch {
    int tag = 0;
    std::vector<std::string> groups;
    bool made_void = false;
    std::size_t quads = 0;
};

/// The patches of a swept mesh, with their quads counted.
std::vector<ShownPatch> shown_patches(const mesh::HexMesh& mesh);

/// Solids as a list. Each has eight corners, of which some are one where it is no hexahedron: a wedge as
/// `mesh::hex_of()` has it, a pyramid {a, b, c, d, e, e, e, e}, a tetrahedron {a, b, c, c, d, d, d, d}.
struct ListedCells {
    std::string name;
    std::vector<Vec3> nodes;
    std::vector<Hex> cells;
    /// Of hexahedra of order 2 all their nodes, as `mesh::CellNodes` has them; a count of 0 for other cells.
    /// Empty where there is none.
    std::vector<mesh::CellNodes> curved;
    std::vector<Index> tags;     ///< numbers of the cells in the file; 0 where it is too large
    std::vector<double> quality; ///< scaled Jacobian; not a number where a cell has none
    std::vector<Quad> sides;     ///< elements of two dimensions; a triangle as {a, b, c, c}
    std::vector<Index> side_patch;
};

/// The solids of a deck, a list a region.
struct DeckCells {
    std::vector<ListedCells> regions;
    std::vector<ShownPatch> patches;
    bool second_order = false; ///< some cells are of order 2
    bool straightened = false; ///< middle nodes of some of them were left out
};
/// @throw InvalidInput "view.no_solids"
DeckCells listed_cells(const io::Deck& deck, const RunContext& context);

} // namespace lacuna::view
