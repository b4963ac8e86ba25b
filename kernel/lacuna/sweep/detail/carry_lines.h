// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <span>
#include <string>
#include <vector>

/// Lines inside ends that continue through several volumes. Internal to this folder.
namespace lacuna::sweep {

/// Split the ends of members, and of their neighbours, along the lines inside the opposite ends: the edges
/// between two faces of one end.
///
/// If such a line is swept to faces that another volume shares, that volume's mesh must contain it, and so on
/// through all following volumes, for instance with branches in a row that leave to different sides, or with
/// a branch on a branch. Each end gets the lines of the opposite one by `surface::imprint_target()`, and each
/// neighbour the parts of the shared faces, until nothing changes.
/// @param volumes  of the members, to which their `volume` points; changed.
/// @return  a line for each member whose ends were split, for the report.
/// @throw NotSweepable "surface.not_imprinted"  as that function, and if the rims of one face have different
///        points in two volumes. "sweep.lines_go_round"  lines that keep adding others.
std::vector<std::string> carry_lines(std::span<const AssemblyMember> members,
                                     std::span<topology::OpenVolume> volumes, const RunContext& context);

} // namespace lacuna::sweep
