// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The loops into which a free loop was split, one for each face that is missing there.
struct SplitLoop {
    std::vector<topology::Loop> parts; ///< all but the last are planar
    bool channel = false;              ///< whether the loop is that of a channel: the first two parts are its
                                       ///< congruent ends
};

/// Split a non-planar free loop by straight void edges into the loops of the faces that are missing there:
/// - a loop in two planes into two planar loops;
/// - the loop of a groove without its ends and its mouth into the loops of these three faces;
/// - the loop of a channel without its ends and one wall into the loops of two planar congruent ends and of
///   the wall.
/// @return  empty for any other loop.
std::optional<SplitLoop> split_loop(topology::Model& model, const topology::Rim& rim);

} // namespace lacuna::closure
