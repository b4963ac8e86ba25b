// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A face of an end turns from the end's mean normal by less than 70°; this is its cosine. Columns run along
/// a steeper face, such as a riser between two steps, and cells beside it have no volume.
inline constexpr double kFacesEnd = 0.34;

/// Cut pieces, and the number of those whose ends were chosen again.
struct ReadPieces {
    std::vector<StepPiece> pieces;
    std::size_t changed = 0;
};

/// Choose the ends of closed cut pieces again, if a piece cannot be swept between its current ends.
///
/// A plane that crosses an end obliquely leaves pieces in which the cut face is adjacent to the rest of that
/// end. A candidate for an end is a connected set of faces whose normals differ by less than 110°, or all
/// faces whose normals are within 60° of the normal of a flat face. Two candidates can be the ends if each
/// wall touches both and has another wall on either side. The function takes the pair that is flattest, most
/// similar and most perpendicular to its walls. It prefers ends that the user named, and pairs for which a
/// cut face that is a wall of both adjacent pieces touches the ends of both along the same edges. Pieces
/// without such ends, or with missing faces, are unchanged.
/// @throw Cancelled
/// @note  O(ends² · faces) per piece, for at most 600 ends; pieces with more than 40 faces are unchanged.
ReadPieces read_ends(std::vector<StepPiece> pieces, const RunContext& context = {});

/// Whether a closed volume has two ends between which each wall runs, as `read_ends()` requires; false for
/// more than 40 faces.
bool walls_run_between_ends(const topology::OpenVolume& volume);

/// Whether columns can run from end to end of a closed volume: no face of an end is as steep as a wall, no
/// wall lies parallel to two opposite ends, and each wall has a corner wherever its neighbour changes from an
/// end to another wall. Without that corner, a cell there would have two collinear sides and no volume.
bool ends_suit_columns(const topology::OpenVolume& volume);

/// @param what  name of the volume in the message: "volume_2".
/// @throw NotSweepable "closure.no_ends"  a closed volume that lacks a source or a target; names its faces.
void check_ends(const topology::OpenVolume& volume, const std::string& what);

} // namespace lacuna::closure
