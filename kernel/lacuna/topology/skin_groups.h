// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>
#include <vector>

namespace lacuna::topology {

/// The groups that quads of each face have in files: that of its role, `source`, `target`, `wall:12` or
/// `void:12`, then its own name where it has one. A name that is another face's role or such a group gets
/// "_2" behind it, or the next number that is free, so that conditions stay on the faces they are for. Upper
/// and lower case are one, as in Abaqus.
std::vector<std::vector<std::string>> skin_groups(const OpenVolume& volume);

} // namespace lacuna::topology
