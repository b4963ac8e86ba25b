// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <string_view>
#include <vector>

namespace lacuna::topology {

/// The groups of each face's quads in output files: the group of its role, `source`, `target`, `wall:12` or
/// `void:12`, and its own name if it has one. Files whose groups do not overlap use the first group: the name
/// that the user or the input gave to the face, otherwise the role. A name that equals a role or another
/// face's group gets the suffix "_2", or the next free number, so that boundary conditions stay on their
/// faces. Case is ignored, as in Abaqus.
///
/// These names come after the role: a name of the solids that a face bounds, a number as a name (`pid:7`,
/// `physical_7`), and a name that all given faces share if they have several roles.
std::vector<std::vector<std::string>> skin_groups(const OpenVolume& volume);

/// Whether a group is a role group: `source`, `target`, `wall:12` or `void:12`, in any case.
bool is_role_group(std::string_view group);

/// The groups of a face of one volume among several. Role groups get the volume's name as a prefix; other
/// groups are listed with and without the prefix.
std::vector<std::string> groups_in_assembly(const std::string& volume,
                                            const std::vector<std::string>& groups);

} // namespace lacuna::topology
