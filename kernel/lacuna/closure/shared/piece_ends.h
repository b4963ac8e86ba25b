// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace lacuna::closure {

/// The normal of a face of an end differs from the end's mean normal by less than 70°; this is the cosine of
/// 70°. A steeper face, such as a riser between two steps, is nearly parallel to the columns, and cells at
/// the face would have almost no volume.
inline constexpr double kFacesEnd = 0.34;

/// Length of the mean normal of a cylinder that turns by a right angle; that of a flat face is 1, that of a
/// full turn 0. A face that bends more cannot belong to an end.
inline constexpr double kQuarterTurn = 2 * std::numbers::sqrt2 / std::numbers::pi;

/// Cut pieces, and the number of those whose ends were chosen again.
struct ReadPieces {
    std::vector<StepPiece> pieces;
    std::size_t changed = 0;
};

/// Whether a piece has at most 64 faces, so that its ends are searched. Pieces with more faces keep their
/// ends; a piece made by a few cuts has fewer.
bool fit_in_set(const topology::Model& model);

/// Choose the ends of closed cut pieces again, if some piece cannot be swept between its current ends.
///
/// A plane that crosses an end obliquely leaves pieces in which the cut face is adjacent to the rest of that
/// end. A candidate for an end is a connected set of faces whose normals differ by less than 110°, or all
/// faces whose normals are within 60° of the normal of a flat face. Two candidates can be the ends if each
/// wall is a ring between them, or has four sides: one at each end and two at walls. The pair with the lowest
/// cost is taken: flat ends, ends of similar area, and ends perpendicular to their walls cost least. Ends
/// that the user named cost less. A cut face that is a wall of both adjacent pieces adds to the cost unless
/// it touches the ends of both along the same edges. Pieces without such ends, or with missing faces, are
/// unchanged.
/// @throw Cancelled
/// @note  O(ends² · faces) per piece, for at most 600 ends; pieces with more than 64 faces are unchanged.
ReadPieces read_ends(std::vector<StepPiece> pieces, const RunContext& context = {});

/// Whether a volume is closed and its source and target meet the conditions of `read_ends()`; false for more
/// than 64 faces.
bool walls_run_between_ends(const topology::OpenVolume& volume);

/// Whether columns of cells can run from end to end of a closed volume. Conditions:
/// - no face of an end is as steep as a wall, compared with its own end and with an opposite one;
/// - no wall is parallel to two opposite ends;
/// - the border of each wall has a corner wherever the adjacent face changes from an end to another wall.
///   Without the corner, a cell there would have two collinear sides and no volume.
bool ends_suit_columns(const topology::OpenVolume& volume);

/// @param what  name of the volume in the message: "volume_2".
/// @throw NotSweepable "closure.no_ends"  the volume is closed but lacks a source or a target; names its
///         faces.
void check_ends(const topology::OpenVolume& volume, const std::string& what);

} // namespace lacuna::closure
