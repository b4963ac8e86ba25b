// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/follow.h>

#include <vector>

namespace lacuna::closure {

/// The paper's Algorithm 2: a void edge between each matched pair of wall-free vertices.
///
/// @param follower  null: straight, as the paper has it; else bent as the given walls lead. @pre it leads
std::vector<EdgeId> make_void_edges(topology::OpenVolume& volume, const matching::Match& match,
                                    const Follower* follower);

} // namespace lacuna::closure
