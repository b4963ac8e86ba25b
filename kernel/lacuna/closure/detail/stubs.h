// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Wall parts that ring a whole loop of one end and stop short of the other: the lowest or the topmost
/// faces of a stack whose middle is missing.
///
/// While the volume is being closed they count as part of that end, so that its open loop is the stub's;
/// what is missing between the ends is then closed as between any source and target.
/// @return  the faces whose role was changed; set them back to Role::wall when the volume is closed.
std::vector<FaceId> lend_stubs_to_ends(topology::OpenVolume& volume);

} // namespace lacuna::closure
