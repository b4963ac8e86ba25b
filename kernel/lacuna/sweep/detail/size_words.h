// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/default_size.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/surface/shared/shape_size.h>
#include <lacuna/sweep/sweep.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::sweep {

/// Estimated number of cells of a sweep.
struct ExpectedCells {
    double all = 0;
    double unasked = 0; ///< number of cells in sweeps without a given size, or without given layers
};

/// The sizes of a sweep's quads, and their origin.
struct SourceSize {
    surface::SizeField asked;
    std::optional<surface::DefaultSize> by_default; ///< if no size is given
    surface::ShapeSizing sizing;
    surface::ShapeSize shape; ///< the requested size, reduced by the shape
    surface::SizeField along; ///< size of the layers; narrow places of the source do not reduce it by default
    /// A narrow place that does not get the default of `kDefaultGap` quads across, because the mesh would
    /// then have too many quads.
    std::optional<surface::SizeCause> too_narrow;
    std::function<int(int least)> layers{}; ///< number of layers as in `VolumePlan`
    bool narrow = false;                    ///< there are, or may be, narrow places
    int across = 0;                         ///< minimum number of rows around a ring; 0: by the size
    ExpectedCells expected{};
};

/// Number of layers, and whether rows of quads on walls or bends of the walls determined it.
struct LayersTaken {
    int count = 0;
    bool by_rows = false;
    bool by_bends = false;
};

/// Lines of the report that explain the origin of a default size, of a given size that the shape reduces, and
/// of a default number of layers.
/// @param volume  the volume to which faces in `sizes` belong. @param split  the volume to which edges in
///         `seeds` belong.
std::vector<std::string> sizes_in_words(const topology::OpenVolume& volume, const topology::OpenVolume& split,
                                        const SourceSize& sizes, const surface::Seeds& seeds,
                                        const SweepOptions& options, const LayersTaken& layers);

} // namespace lacuna::sweep
