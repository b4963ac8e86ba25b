// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/side_lines.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::matching {

/// Sections of the walls on one source loop, if these walls do not form a ring. They contain only points of
/// these walls, not the points that `cut_sections()` adds.
struct LoopSections {
    std::vector<Index> rim;                ///< model points of the loop
    std::vector<FaceId> faces;             ///< the walls
    std::vector<std::vector<Vec3>> levels; ///< as in `Sections`
};

/// Sections through the given walls at even heights, as corresponding points.
struct Sections {
    std::vector<double> heights; ///< by point of the model, from `wall_heights()`
    std::vector<Vec3> areas;     ///< by level: sum of the area vectors of its level lines, pointing up the
                                 ///< walls
    std::vector<std::vector<Vec3>>
        levels;          ///< by level, from source to target rim; points with the same index correspond
    bool closed = false; ///< whether some connected part of the walls is a closed ring; parts that are no
                         ///< rings are then ignored
    /// Sections of the loops whose walls form no ring, but cover enough of the loop to extrapolate the rest.
    std::vector<LoopSections> loops;
};

/// Cut the given walls at `kFineChords` + 1 even heights.
///
/// The height is harmonic (`wall_heights()`), so its level lines cut a bent tube about perpendicularly to the
/// tube's axis. A level line is traversed with the uphill side on its left and sampled evenly between the
/// side lines that it crosses. A closed line that crosses no side line starts where it best matches the level
/// below.
///
/// Wall part: a connected part of the walls. If any wall part is a closed ring, parts with open level lines
/// are ignored. An open level line is completed for the fit: it gets two additional points off the wall,
/// because a straight line does not determine the rotation about itself; and its area is increased by that of
/// a circle whose circumference is the distance between the line's ends. If some walls of a part end between
/// the rims, the open lines of the part are trimmed to the side lines that all of them cross. A wall part is
/// ignored if a level cuts it in several lines (because of holes) or if it does not join both rims.
/// @param lines  side_lines() of the volume
Sections cut_sections(const topology::OpenVolume& volume, const std::vector<SideLine>& lines,
                      const RunContext& context = {});

} // namespace lacuna::matching
