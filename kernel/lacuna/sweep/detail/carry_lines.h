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
/// If such a line is swept to faces that another volume shares, that volume's mesh must contain the line, and
/// so on through all following volumes. This happens, for instance, with branches in a row that leave to
/// different sides, or with a branch on a branch. Each end gets the lines of the opposite end by
/// `surface::imprint_target()`, and each neighbour gets the parts of the shared faces, until nothing changes.
/// @param volumes  the members' volumes, to which their `volume` points; changed.
/// @return  a line of the report for each member whose ends were split.
/// @throw NotSweepable "surface.not_imprinted"  as `surface::imprint_target()`, and if the rims of one face
///     have different points in two volumes. "sweep.lines_go_round"  lines that keep adding others.
std::vector<std::string> carry_lines(std::span<const AssemblyMember> members,
                                     std::span<topology::OpenVolume> volumes, const RunContext& context);

} // namespace lacuna::sweep
