// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// The loops of the two ends of a volume that has walls only.
struct EndLoops {
    std::vector<topology::Loop> source, target; ///< oriented as in the end faces; the outermost first
};

/// The first connected part of the walls that does not have two free loops; empty if all are tubes.
std::vector<FaceId> no_tube(const topology::OpenVolume& volume);

/// Divide the free loops between source and target, as in steps 3 to 6 of the paper's Algorithm 11 (see
/// docs/bibliography.md).
///
/// Each connected part of the walls is a tube with a free loop at either end. The largest tube defines the
/// two ends. Each loop of another tube belongs to the nearer end. A tube inside another one is reversed, so
/// that its walls face the void.
/// @throw NotClosed  a part with one loop or more than two, a tube that is equally close to both ends, tubes
///         side by side; names the walls.
EndLoops group_loops(topology::OpenVolume& volume);

/// Walls that belong to an end: flat faces that surround one of the end's loops, lie in its plane, and have
/// walls along all their other edges, such as the annular step of a counterbore.
std::vector<FaceId> floors_round(const topology::OpenVolume& volume, const std::vector<topology::Loop>& end);

} // namespace lacuna::closure
