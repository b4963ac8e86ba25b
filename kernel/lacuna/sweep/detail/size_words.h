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

/// Cells that are to be expected of a sweep before anything is meshed.
struct ExpectedCells {
    double all = 0;
    double unasked = 0; ///< of sweeps for which not both the size and the layers are given
};

/// The sizes of a sweep's quads, and where they come from.
struct SourceSize {
    surface::SizeField asked;
    std::optional<surface::DefaultSize> by_default; ///< where nobody asked
    surface::ShapeSizing sizing;
    surface::ShapeSize shape; ///< asked, and smaller where the shape needs it
    surface::SizeField along; ///< of the layers: without what narrow places ask for by default
    /// A place too narrow for `kDefaultGap` quads across, which nobody asked for: they would be too many in
    /// all.
    std::optional<surface::SizeCause> too_narrow;
    std::function<int(int least)> layers{}; ///< of `VolumePlan`
    bool narrow = false;                    ///< quads are to be across places that are, or may be, narrow
    ExpectedCells expected{};
};

/// How many layers there are, and whether rows of quads on walls or bends of the walls said so.
struct LayersTaken {
    int count = 0;
    bool by_rows = false;
    bool by_bends = false;
};

/// A line for the size that was taken by default, or for one asked for that the shape makes smaller, and a
/// line for a number of layers that nobody asked for: what they are and what they were taken from.
/// @param volume  whose faces `sizes` names. @param split  whose edges `seeds` names.
std::vector<std::string> sizes_in_words(const topology::OpenVolume& volume, const topology::OpenVolume& split,
                                        const SourceSize& sizes, const surface::Seeds& seeds,
                                        const SweepOptions& options, const LayersTaken& layers);

} // namespace lacuna::sweep
