// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Add to each end the walls that surround a whole loop of that end and do not reach the other end: the
/// lowest or topmost faces of a stack whose middle is missing.
///
/// The free rim of these walls then is the end's open loop, so the gap can be closed as between any source
/// and target.
/// @return  the faces whose role changed; set them back to Role::wall after closing.
std::vector<FaceId> lend_stubs_to_ends(topology::OpenVolume& volume);

} // namespace lacuna::closure
