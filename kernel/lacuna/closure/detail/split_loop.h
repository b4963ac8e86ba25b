// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A free loop as those of the faces that are missing there.
struct SplitLoop {
    std::vector<topology::Loop> parts; ///< all but the last flat
    bool channel = false;              ///< whether the first two are ends that are alike
};

/// Part a free loop that lies in no plane, by straight void edges: where it lies in two planes into two flat
/// parts; that of a groove without its ends and its mouth into theirs; that of a channel without its ends and
/// a wall into the ends', which lie in planes and are alike, and the wall's.
/// @return  nothing where it is none of these.
std::optional<SplitLoop> split_loop(topology::Model& model, const topology::Rim& rim);

} // namespace lacuna::closure
