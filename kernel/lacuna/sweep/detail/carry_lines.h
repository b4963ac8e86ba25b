// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <span>
#include <string>
#include <vector>

/// Lines inside of ends that go on through several volumes. Internal to this folder.
namespace lacuna::sweep {

/// Split the ends of members, and with them their neighbours', as the lines inside the opposite ends need.
///
/// Where a line between two faces of an end is swept to faces that another volume has too, that volume's
/// mesh has to hold it, and so on through all that follow it: as of branches in a row that turn from side to
/// side, or of a branch on a branch. Each end gets the lines of the opposite one by
/// `surface::imprint_target()`, and each neighbour the parts of the faces it shares, until no end gets
/// another.
/// @param volumes  of the members, which their `volume` names; changed.
/// @return  a line for each member whose ends were split, for the report.
/// @throw NotSweepable "surface.not_imprinted"  as that, and where the rims of one face have other points in
///        two volumes. "sweep.lines_go_round"  lines that add others all the time.
std::vector<std::string> carry_lines(std::span<const AssemblyMember> members,
                                     std::span<topology::OpenVolume> volumes, const RunContext& context);

} // namespace lacuna::sweep
