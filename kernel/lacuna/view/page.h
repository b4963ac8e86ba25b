// SPDX-License-Identifier: MIT
#pragma once

// In: a model, a volume, meshes or a deck; out: an HTML page or a PNG picture.
//
// Where to change things:
//   page of a model or a volume  faces_page.cpp
//   page of cells                cells_page.cpp; cells, their groups and quality: cell_set.cpp
//   frame and file of a page     page.cpp; script and style: page/
//   numbers inside a page        base64.cpp, json.cpp
//   picture: what is drawn       picture.cpp, scene.cpp; colours of quality: palette.cpp
//   picture: legend, letters     legend.cpp, stroke_font.cpp
//   picture: pixels, file        raster.cpp, png.cpp

#include <lacuna/core/run_context.h>
#include <lacuna/io/deck.h>
#include <lacuna/io/whole_file.h>
#include <lacuna/mesh/hex_mesh.h>
#include <lacuna/topology/open_volume.h>

#include <span>
#include <string>

/// Pages for a browser, and pictures.
///
/// A page is one HTML file that contains its style, script and data. It loads nothing, and its content
/// security policy forbids network access. It draws with WebGL 2. Texts of the input are embedded as data,
/// never as markup.
namespace lacuna::view {

/// A swept mesh and the name of its region.
struct Region {
    const mesh::HexMesh* mesh = nullptr; ///< read, not kept
    std::string name = "volume";
};

struct PageOptions {
    std::string title{}; ///< empty: the name of the input
    /// File loaded by the recipe on the page of a model; empty: the recipe starts with the faces.
    std::string path{};
};

/// Write a page of a mesh. The user can rotate it, cut it by a plane (showing whole cells), hide layers, and
/// colour it by quality, layer, group, region or origin; the page has a histogram and lists the worst cells.
///
/// A swept region is stored as source quads and nodes, with coordinates rounded to 2^-21 of the largest
/// extent; the page computes cells, skin and cuts. Cells of order 2 are drawn with their middle nodes.
/// @pre    at least one region; the regions of an assembly in the order of the assembly.
/// @throw  InvalidInput, BackendError  as `io::WholeFile`; Cancelled
/// @note   A million hexahedra of a twisted block take 2.5 MB. O(cells).
void write_page(std::span<const Region> regions, const io::OutputPath& path, const PageOptions& options = {},
                const RunContext& context = {});

/// Write a page of the solids in a file. Of order-2 cells, only hexahedra are drawn with their middle nodes.
/// Two-dimensional elements define the groups of the skin.
/// @throw InvalidInput "view.no_solids"  the deck has no solids.
void write_page(const io::Deck& deck, const io::OutputPath& path, const PageOptions& options = {},
                const RunContext& context = {});

/// Write a page of the faces of a model, with labels and descriptions. The user composes a recipe by clicking
/// source, target and walls, or faces whose roles are then found automatically. Edges that only one face uses
/// are marked. The user can also select cavities and unsewn gaps, which `closure::model_facts()` finds.
/// @throw  as `io::WholeFile`; Cancelled
/// @note   Takes about as long as `closure::model_facts()`.
void write_page(const topology::Model& model, const io::OutputPath& path, const PageOptions& options = {},
                const RunContext& context = {});

/// Write a page of an open or sealed volume: its roles, void faces, free edges, and end vertices that are on
/// no wall.
void write_page(const topology::OpenVolume& volume, const io::OutputPath& path,
                const PageOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::view
