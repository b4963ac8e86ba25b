// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/side_lines.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::matching {

/// Sections of the open walls on one source loop. They contain points of these walls only.
struct LoopSections {
    std::vector<Index> rim;                ///< model points of the loop
    std::vector<FaceId> faces;             ///< the walls
    std::vector<std::vector<Vec3>> levels; ///< as in `Sections`
};

/// Sections through the given walls at even heights, as corresponding points.
struct Sections {
    std::vector<double> heights; ///< over the whole model, from `wall_heights()`
    std::vector<Vec3> areas;     ///< area vector of each level's lines, pointing up the walls
    std::vector<std::vector<Vec3>>
        levels;          ///< by level, from source to target rim; points with the same index correspond
    bool closed = false; ///< whether a wall part is a closed ring; open wall parts are then ignored
    /// Sections of the loops whose open walls reach far enough round to extrapolate the rest of the loop.
    std::vector<LoopSections> loops;
};

/// Cut the given walls at `count` + 1 even heights.
///
/// The height is harmonic, so its level lines cut a bent tube about square to its axis. A level line is
/// traversed with the uphill side on its left and sampled evenly between the side lines that it crosses. A
/// closed line that crosses none starts where it best matches the level below.
///
/// If any wall part is a closed ring, open ones are ignored. An open line gets two extra points off the wall,
/// because a straight line does not fix the rotation about itself. Its area is increased by that of a circle
/// whose circumference is the distance between its ends. Open lines of walls that end between the rims are
/// trimmed to the side lines that they share. A wall part is ignored if a level cuts it in several lines
/// (holes) or if it does not join both rims.
/// @param lines  side_lines() of the volume
Sections cut_sections(const topology::OpenVolume& volume, const std::vector<SideLine>& lines, int count,
                      const RunContext& context = {});

} // namespace lacuna::matching
