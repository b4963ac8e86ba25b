// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/closure/shared/follow.h>

#include <vector>

/// Closes a volume of any class with a given shape of void edges and ends. Internal to this folder.
namespace lacuna::closure {

/// The shapes of the missing edges and faces.
struct Way {
    EdgeShape edges = EdgeShape::straight; ///< not automatic
    Cap cap = Cap::flat;                   ///< not automatic
    bool planes = false;                   ///< whether a missing end whose rim lies in several planes gets
                                           ///< one flat face per plane
};

/// Inputs of every closing method.
struct Tools {
    Way way;
    const Follower* follower; ///< null if the given walls define no motion
    const std::vector<VoidEdge>& by_hand;
    const RunContext& context;

    /// The motion that void faces next to given walls follow; null if void edges do not follow the walls.
    [[nodiscard]] const Follower* bending() const
    {
        return way.edges == EdgeShape::follow ? follower : nullptr;
    }
};

/// Close a volume of class `value`: add the missing entities, and orient the faces so that the enclosed
/// volume is positive. Does not check that the volume is sealed.
/// @throw NotClosed, or the errors of the face shapes
Closure close_as(topology::OpenVolume& volume, const matching::Match& match, topology::VolumeClass value,
                 const Tools& tools);

} // namespace lacuna::closure
