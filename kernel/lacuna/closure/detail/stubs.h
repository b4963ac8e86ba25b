// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Give walls that touch only one end the role of that end: for example the lowest and the topmost faces of a
/// stack whose middle is missing.
///
/// Such walls form a connected part with two rims, of which one is a whole loop of the end and the other is
/// free. The free rim then is the open loop of the end, and the gap can be closed like that between any
/// source and target.
/// @return  the faces whose role changed. The caller sets them back to Role::wall after closing.
std::vector<FaceId> lend_stubs_to_ends(topology::OpenVolume& volume);

} // namespace lacuna::closure
