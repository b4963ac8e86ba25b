// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <string_view>
#include <vector>

namespace lacuna::topology {

/// The groups that quads of each face have in files: that of its role, `source`, `target`, `wall:12` or
/// `void:12`, and its own name where it has one. The first is the one in files whose groups do not overlap:
/// the name that the user or the input gave to the face, else its role. A name that is another face's role or
/// such a group gets "_2" behind it, or the next number that is free, so that conditions stay on the faces
/// they are for. Upper and lower case are one, as in Abaqus.
///
/// These names come after the role: that of the solids a face bounds, a number that stands for one (`pid:7`,
/// `physical_7`), and one that all given faces have, of several roles.
std::vector<std::vector<std::string>> skin_groups(const OpenVolume& volume);

/// Whether a group is that of a role: `source`, `target`, `wall:12` or `void:12`, in any case.
bool is_role_group(std::string_view group);

} // namespace lacuna::topology
