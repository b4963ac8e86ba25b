// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// The loops of the two ends of a volume of walls alone.
struct EndLoops {
    std::vector<topology::Loop> source, target; ///< as the end faces use them; the outermost first
};

/// The first connected part of the walls that has not two free loops, as a tube has; empty where all have.
std::vector<FaceId> no_tube(const topology::OpenVolume& volume);

/// Steps 3 to 6 of the paper's Algorithm 11: sort the free loops into two subsets a sweeping distance apart.
///
/// Each connected part of the walls is a tube with a loop at either end. The largest tube says where the
/// ends are; every other tube's loops go to the ends they are nearer to. Tubes that lie inside another are
/// turned over, so that their wall faces the void.
/// @throw NotClosed  a part with one loop or more than two, a tube that is as near to either end, tubes
///         side by side; names the walls.
EndLoops group_loops(topology::OpenVolume& volume);

/// Walls that are part of an end: flat faces that lie round one of its loops in the loop's own plane, and go
/// on into other walls all round elsewhere, as the floor of a bore does round a narrower bore in it.
std::vector<FaceId> floors_round(const topology::OpenVolume& volume, const std::vector<topology::Loop>& end);

} // namespace lacuna::closure
