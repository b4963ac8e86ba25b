// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::closure {

/// Wall parts that surround a whole loop of one end and do not reach the other: the lowest or topmost faces
/// of a stack whose middle is missing.
///
/// During closing they count as part of that end, so that its open loop is their free rim; the gap is then
/// closed as between any source and target.
/// @return  the faces whose role changed; set them back to Role::wall after closing.
std::vector<FaceId> lend_stubs_to_ends(topology::OpenVolume& volume);

} // namespace lacuna::closure
