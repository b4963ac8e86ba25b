// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/view/page.h>

#include <array>
#include <optional>

namespace lacuna::view {

/// Cells whose centre lies behind a plane are shown whole, the others not at all.
struct CutPlane {
    Vec3 point = Vec3::Zero();   ///< [model length]
    Vec3 normal = Vec3::UnitZ(); ///< to the side that is left out; of any length but 0
};

/// What the colours of a mesh say.
enum class ColourBy {
    quality, ///< scaled Jacobian: from red over pale to blue, which is 1
    layer,   ///< from dark at the source to light at the target
    group,   ///< a colour a face of the volume, sides inside pale
    region,  ///< a colour a region
    origin,  ///< given or void
};

struct PictureOptions {
    int width = 1200, height = 900; ///< >= 16 [pixels]
    Vec3 direction{1, -1.6, 0.9};   ///< from what is seen to the eye, of any length but 0
    ColourBy colour = ColourBy::quality;
    std::optional<CutPlane> cut{};              ///< of cells
    std::optional<std::array<int, 2>> layers{}; ///< first and last that is shown, from 1; none: all
    bool edges = true;                          ///< sides of cells and quads
    bool facets = false;                        ///< of faces: sides of their facets
    bool legend = true;                         ///< title, and what the colours mean
    std::string title{};                        ///< empty: the name of what is shown, and its counts
};

/// Draw a mesh into a PNG without a display: a parallel projection onto white, hidden parts removed by depth,
/// nine samples a pixel.
/// @pre    a region at least.
/// @throw  InvalidInput "view.picture_size"  a width or height below 16 or above 16384;
///                      "view.direction"     a direction or a normal without length;
///                      "view.layers"        layers that the mesh does not have;
///                      "view.empty"         the cut leaves no cell.
///         as `io::WholeFile`. Cancelled.
/// @note   The same for any thread count. O(cells + pixels).
void write_picture(std::span<const Region> regions, const io::OutputPath& path,
                   const PictureOptions& options = {}, const RunContext& context = {});

/// The same of faces: each pale, with its edges, those of one face alone red. Of meshes that faces came with,
/// the sides are drawn.
void write_picture(const topology::Model& model, const io::OutputPath& path,
                   const PictureOptions& options = {}, const RunContext& context = {});

/// The same of a volume: source green, target red, walls blue, void faces hatched.
void write_picture(const topology::OpenVolume& volume, const io::OutputPath& path,
                   const PictureOptions& options = {}, const RunContext& context = {});

} // namespace lacuna::view
