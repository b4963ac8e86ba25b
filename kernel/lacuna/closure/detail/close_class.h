// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/follow.h>

#include <vector>

/// How a volume of each class is closed, in one way to shape what is missing. Internal to this folder.
namespace lacuna::closure {

/// One way to shape what is missing.
struct Way {
    EdgeShape edges = EdgeShape::straight; ///< not automatic
    Cap cap = Cap::flat;                   ///< not automatic
    bool planes = false; ///< whether a missing end that lies in several planes is a flat face in each
};

/// What every way of closing needs.
struct Tools {
    Way way;
    const Follower* follower; ///< null where the given walls lead nowhere
    const std::vector<VoidEdge>& by_hand;
    const RunContext& context;

    /// What void faces bend along beside their edges; null: nothing.
    [[nodiscard]] const Follower* bending() const
    {
        return way.edges == EdgeShape::follow ? follower : nullptr;
    }
};

/// Close a volume as one of a class: what is missing is added to it, and faces are turned so that it encloses
/// what is above 0. Whether it is sealed is not proved here.
/// @throw NotClosed, or what shapes void faces throws
Closure close_as(topology::OpenVolume& volume, const matching::Match& match, topology::VolumeClass value,
                 const Tools& tools);

} // namespace lacuna::closure
