// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A free loop, split into the loops of the faces that are missing there.
struct SplitLoop {
    std::vector<topology::Loop> parts; ///< all but the last planar
    bool channel = false;              ///< whether the first two are congruent ends
    bool is_assumed =
        false; ///< whether one of two planar parts has only two given edges, which any plane fits
};

/// Split a non-planar free loop by straight void edges: a loop in two planes into two planar parts; the loop
/// of a groove that lacks its ends and its mouth into the loops of these; the loop of a channel that lacks
/// its ends and one wall into those of two planar congruent ends and of the wall.
/// @return  empty for any other loop.
std::optional<SplitLoop> split_loop(topology::Model& model, const topology::Rim& rim);

} // namespace lacuna::closure
