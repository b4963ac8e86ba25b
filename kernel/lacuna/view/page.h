// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/topology/open_volume.h>

#include <span>
#include <string>

/// What a person looks at: pages that a browser shows, and pictures.
///
/// A page is one file of HTML that asks for nothing from anywhere: style, script and data are in it, and it
/// forbids itself the network. It draws with WebGL 2. Texts of the input are data in it, never markup.
namespace lacuna::view {

/// A swept mesh, and the name of the region it is.
struct Region {
    const mesh::HexMesh* mesh = nullptr; ///< read, not kept
    std::string name = "volume";
};

struct PageOptions {
    std::string title{}; ///< empty: what the input is called
    /// The file that the recipe on the page of a model loads; empty: the recipe begins with the faces.
    std::string path{};
};

/// A page of a mesh: turned, cut by a plane with whole cells shown, peeled by layers, coloured by quality,
/// layer, group, region or origin, with a histogram and the worst cells.
///
/// A swept region is sent as its source quads and its nodes, whose coordinates are rounded to 2^-21 of the
/// largest extent; the page computes cells, skin and cuts. Order 2 is drawn with its middle nodes.
/// @pre    a region at least; those of an assembly in its order.
/// @throw  InvalidInput, BackendError  as `io::WholeFile`. Cancelled.
/// @note   A million hexahedra of a twisted block take 2.5 MB. O(cells).
void write_page(std::span<const Region> regions, const io::OutputPath& path, const PageOptions& options = {},
                const RunContext& context = {});

/// The same of the solids of a file; of order 2 hexahedra alone are drawn with their middle nodes. Elements
/// of two dimensions give the skin its groups.
/// @throw InvalidInput "view.no_solids"  the deck has no solids.
void write_page(const io::Deck& deck, const io::OutputPath& path, const PageOptions& options = {},
                const RunContext& context = {});

/// A page of faces: labelled, described where the mouse is, and clicked to collect a recipe's source, target
/// and walls, or faces without roles. Edges of one face alone are marked. Cavities and unsewn gaps, as
/// closure::model_facts() finds them, are listed to be picked.
/// @throw  as `io::WholeFile`. Cancelled.
/// @note   As closure::model_facts().
void write_page(const topology::Model& model, const io::OutputPath& path, const PageOptions& options = {},
                const RunContext& context = {});

/// The same of an open or a sealed volume: its roles, what was made void, free edges, vertices of the ends
/// that are on no wall.
void write_page(const topology::OpenVolume& volume, const io::OutputPath& path,
                const PageOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::view
