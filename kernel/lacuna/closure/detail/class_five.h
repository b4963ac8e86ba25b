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

/// Steps 3 to 6 of the paper's Algorithm 11: sort the free loops into two sets a sweeping distance apart.
///
/// Each connected part of the walls is a tube with a loop at either end. The largest tube defines the two
/// ends; the loops of every other tube go to the nearer end. Tubes inside another are reversed, so that their
/// walls face the void.
/// @throw NotClosed  a part with one loop or more than two, a tube that is equally close to both ends, tubes
///         side by side; names the walls.
EndLoops group_loops(topology::OpenVolume& volume);

/// Walls that are part of an end: flat faces in the plane of one of its loops that surround it and are
/// connected to other walls all round, like the floor of a bore round a narrower bore.
std::vector<FaceId> floors_round(const topology::OpenVolume& volume, const std::vector<topology::Loop>& end);

} // namespace lacuna::closure
