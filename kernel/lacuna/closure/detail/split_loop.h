// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A free loop, split into the loops of the faces that are missing there.
struct SplitLoop {
    std::vector<topology::Loop> parts; ///< all but the last are planar
    bool channel = false;              ///< whether the first two parts are congruent ends
    /// Whether a planar part has only two straight given edges, which meet or are parallel. These are always
    /// coplanar, so they do not show that a flat face is missing.
    bool is_assumed = false;
};

/// Split a non-planar free loop by straight void edges into the loops of the faces that are missing there:
/// - a loop in two planes into two planar loops;
/// - the loop of a groove without its ends and its mouth into the loops of these three faces;
/// - the loop of a channel without its ends and one wall into the loops of two planar congruent ends and of
///   the wall.
/// @return  empty for any other loop.
std::optional<SplitLoop> split_loop(topology::Model& model, const topology::Rim& rim);

} // namespace lacuna::closure
