// SPDX-License-Identifier: MIT
#pragma once

#include "support/volumes.h"

#include <lacuna/closure/close.h>

#include <string>
#include <vector>

namespace lacuna::test {

/// One open volume of the family: every class with all numbers of loops, targets, edges and twists.
struct Member {
    topology::VolumeClass value = topology::VolumeClass::I;
    int loops = 1; ///< the outer one and holes
    End target = End::planar;
    int edges = 4;       ///< of each loop; 1: circles with one vertex
    int twist = 0;       ///< of the target against the source [degrees]
    bool halved = false; ///< circles with half of each wall missing, which makes two edges of the one

    [[nodiscard]] std::string name() const;
};

/// All members of a class.
std::vector<Member> members(topology::VolumeClass value);

/// How a member is made: which parts are left out is what makes its class.
PrismOptions options_of(const Member& member);

/// How a member ended.
struct Ending {
    std::string code;    ///< of the refusal; "meshed" without one
    std::string message; ///< of the refusal
    std::vector<std::string>
        faults; ///< what is wrong with the class, the closing or the mesh; none in a good ending
};

/// Open, match, close and sweep a member, and look for faults at every stage.
Ending run(const Member& member, closure::EdgeShape shape = closure::EdgeShape::automatic);

} // namespace lacuna::test
