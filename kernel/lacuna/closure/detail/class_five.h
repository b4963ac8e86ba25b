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

/// Assign each free loop to the source or the target, as in steps 3 to 6 of the paper's Algorithm 11 (see
/// docs/bibliography.md).
///
/// Each connected part of the walls is a tube with a free loop at either end. The largest tube defines the
/// two ends. Each loop of another tube belongs to the nearer of these two ends. The walls of a tube inside
/// another one are flipped, so that they face the void.
/// @throw NotClosed  a connected part does not have two free loops, a tube is equally close to both ends, or
///         tubes lie side by side; names the walls.
EndLoops group_loops(topology::OpenVolume& volume);

/// Walls that may belong to an end, such as the annular step of a counterbore. Such a wall surrounds one of
/// the end's loops, lies in the plane of this loop, and has other walls along all its other edges.
std::vector<FaceId> floors_round(const topology::OpenVolume& volume, const std::vector<topology::Loop>& end);

} // namespace lacuna::closure
