// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/follow.h>

#include <vector>

/// Closing a volume of each class with one method for the missing shapes. Internal to this folder.
namespace lacuna::closure {

/// A method to shape the missing edges and faces.
struct Way {
    EdgeShape edges = EdgeShape::straight; ///< not automatic
    Cap cap = Cap::flat;                   ///< not automatic
    bool planes = false;                   ///< a missing end in several planes gets one flat face per plane
};

/// Inputs of every closing method.
struct Tools {
    Way way;
    const Follower* follower; ///< null if the given walls define no motion
    const std::vector<VoidEdge>& by_hand;
    const RunContext& context;

    /// The motion that void faces follow next to their edges; null: none.
    [[nodiscard]] const Follower* bending() const
    {
        return way.edges == EdgeShape::follow ? follower : nullptr;
    }
};

/// Close a volume of a class: add the missing entities and orient the faces so that the enclosed volume is
/// positive. Does not check that the volume is sealed.
/// @throw NotClosed, or the errors of the face shapes
Closure close_as(topology::OpenVolume& volume, const matching::Match& match, topology::VolumeClass value,
                 const Tools& tools);

} // namespace lacuna::closure
