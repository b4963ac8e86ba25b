// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <string_view>
#include <vector>

namespace lacuna::topology {

/// The groups of each face's quads in output files: role groups (`source` or `target`, and `wall:12`,
/// `face:12` for a given face of an end, or `void:12`), and the face's own name if it has one. File formats
/// that allow one group per quad use the first group.
///
/// The first group is the face's name, if the user or the input gave it one. The role group comes first if
/// there is no name, or if the name does not identify the face:
/// - it is the name of a solid that the face bounds;
/// - it is a number (`pid:7`, `physical_7`);
/// - all given faces have this name, and they have several roles.
///
/// A name that equals the role group of another face gets the suffix "_2", or the next free number, so that
/// boundary conditions stay on their faces. Case is ignored, as in Abaqus.
std::vector<std::vector<std::string>> skin_groups(const OpenVolume& volume);

/// Whether a group belongs to a void face: `void:3`, or `fluid:void:3` in an assembly.
bool is_void_group(std::string_view group);

/// Whether a group is a role group: `source`, `target`, `wall:12`, `face:12` or `void:12`, in any case.
bool is_role_group(std::string_view group);

/// The groups of a face of one volume among several. Role groups get the volume's name as a prefix; other
/// groups are listed with and without the prefix.
std::vector<std::string> groups_in_assembly(const std::string& volume,
                                            const std::vector<std::string>& groups);

} // namespace lacuna::topology
