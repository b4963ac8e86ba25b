// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/view/page.h>

#include <array>
#include <optional>

namespace lacuna::view {

/// Plane that cuts a picture of cells: a cell is shown whole if its centre is behind the plane (on the side
/// opposite to the normal), and hidden otherwise.
struct CutPlane {
    Vec3 point = Vec3::Zero();   ///< [model length]
    Vec3 normal = Vec3::UnitZ(); ///< points to the hidden side; any length except 0
};

/// What the colours of a mesh represent.
enum class ColourBy {
    quality, ///< scaled Jacobian: red is poor, pale is medium, blue is 1
    layer,   ///< from dark at the source to light at the target
    group,   ///< one colour for each face of the volume; inner sides are pale
    region,  ///< one colour for each region
    origin,  ///< given or void
};

struct PictureOptions {
    int width = 1200, height = 900; ///< >= 16 [pixels]
    Vec3 direction{1, -1.6, 0.9};   ///< from the object to the viewer; any length except 0
    ColourBy colour = ColourBy::quality;
    std::optional<CutPlane> cut{};              ///< hides cells
    std::optional<std::array<int, 2>> layers{}; ///< first and last visible layer, from 1; none: all
    bool edges = true;                          ///< draw sides of cells and quads
    bool facets = false;                        ///< draw sides of facets, in pictures of faces
    bool legend = true;                         ///< draw the title and the colour legend
    std::string title{};                        ///< empty: the name of the object, and its counts
};

/// Draw a mesh to a PNG file without a display: parallel projection on white, hidden surfaces removed with a
/// depth buffer, nine samples per pixel.
/// @pre    at least one region.
/// @throw  InvalidInput "view.picture_size"  a width or height below 16 or above 16384;
///                      "view.direction"     the view direction or the normal has zero length;
///                      "view.layers"        layers that the mesh does not have;
///                      "view.empty"         the cut hides all cells;
///         or as `io::WholeFile`; Cancelled
/// @note   Independent of the number of threads. O(cells + pixels).
void write_picture(std::span<const Region> regions, const io::OutputPath& path,
                   const PictureOptions& options = {}, const RunContext& context = {});

/// Draw the solids of a deck, with straight sides. Two-dimensional elements define the groups of the skin.
/// @throw InvalidInput  as for swept meshes; "view.no_solids"  the deck has no solids; "view.layers"  colours
///                      by layer, or visible layers, are requested, but a deck has no layers.
void write_picture(const io::Deck& deck, const io::OutputPath& path, const PictureOptions& options = {},
                   const RunContext& context = {});

/// Draw faces in pale colours with their edges; edges that only one face uses are red. On faces that came
/// with a mesh, the sides of its elements are drawn.
void write_picture(const topology::Model& model, const io::OutputPath& path,
                   const PictureOptions& options = {}, const RunContext& context = {});

/// Draw a volume: source green, target red, walls blue, void faces hatched.
void write_picture(const topology::OpenVolume& volume, const io::OutputPath& path,
                   const PictureOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::view
