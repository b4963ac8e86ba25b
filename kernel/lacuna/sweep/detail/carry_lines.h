// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <span>
#include <string>
#include <vector>

/// Lines inside ends that continue through several volumes. Internal to this folder.
namespace lacuna::sweep {

/// Split the ends of members, and of their neighbours, along the lines inside the opposite ends. A line is an
/// edge between two faces of one end.
///
/// If the sweep maps such a line to faces that another volume shares, the mesh of that volume must contain
/// the line, and so on from volume to volume. Examples: consecutive branches that leave a main body on
/// different sides, and a branch on a branch. `surface::imprint_target()` copies the lines of one end to the
/// opposite end, and the split of a shared face is copied to the neighbour, until nothing changes.
/// @param volumes  the members' volumes, to which their `volume` points; changed.
/// @return  a line of the report for each member whose ends were split.
/// @throw NotSweepable "surface.not_imprinted"  as `surface::imprint_target()`, or the rims of a shared face
///         have different points in its two volumes; "sweep.lines_go_round"  after 64 rounds, copied lines
///         still add new lines.
std::vector<std::string> carry_lines(std::span<const AssemblyMember> members,
                                     std::span<topology::OpenVolume> volumes, const RunContext& context);

} // namespace lacuna::sweep
