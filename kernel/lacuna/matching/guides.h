// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/matching/side_lines.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::matching {

/// Sections of open walls that stand on one loop of the source: its own points alone.
struct LoopSections {
    std::vector<Index> rim;                ///< model points of that loop
    std::vector<FaceId> faces;             ///< the walls
    std::vector<std::vector<Vec3>> levels; ///< as in `Sections`
};

/// Sections through the given walls at even heights, as corresponding points.
struct Sections {
    std::vector<double> heights; ///< all points of the model: `wall_heights()`
    std::vector<Vec3> areas;     ///< of each level: area of its lines, along the way up the walls
    std::vector<std::vector<Vec3>>
        levels; ///< level by level from the source rim to the target rim; point i of each corresponds
    bool closed = false; ///< some wall part goes all round: its sections leave nothing to be guessed
    /// Of loops with open walls that reach round far enough to say how the rest of the loop goes.
    std::vector<LoopSections> loops;
};

/// Cut the given walls at `count` + 1 levels of their height.
///
/// The height is harmonic, so its level lines cut a bent tube about square to its run. A level line is
/// walked with the rise on its left and sampled evenly between the side lines it crosses; a closed one that
/// crosses none is started where it lies best on the level below. An open line is given two points off the
/// wall and the area of a round line as long as its gap, by the way up the wall: a straight one by itself
/// leaves open how it is turned. Beside walls that go all round, open ones are left out. Open lines of walls
/// that go only part of the way are cut to the side lines they share. Wall parts that a level cuts in several
/// lines (holes), or that do not join both rims, are left out.
/// @param lines  side_lines() of the volume
Sections cut_sections(const topology::OpenVolume& volume, const std::vector<SideLine>& lines, int count,
                      const RunContext& context = {});

} // namespace lacuna::matching
