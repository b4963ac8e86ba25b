// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/message.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/auto_roles.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A sealed volume, and the match with which close() gives the same result for default options.
struct SealedVolume : Closed {
    matching::Match match;
};

/// A sealed void and its other sweep directions, best first; the direction that the reading of the void uses
/// is not among them. A hollow whose bottom is split from its walls has no other direction: `ways` is empty,
/// and the faces of `volume` are not split.
struct OtherSweeps : Closed {
    std::vector<topology::RoleCandidate> ways; ///< the other directions; the roles name faces of `volume`
};

/// A void that some faces enclose, with the roles for a sweep in its best direction.
struct Reading {
    topology::RoleCandidate roles; ///< the roles name faces of the model
    topology::OpenVolume volume;   ///< the faces with these roles; open or sealed
    topology::Classification classification;
    /// Set if `volume` is sealed, for example because an end is a void face.
    std::optional<Closure> closure;
    /// Set if `volume` is open and was sealed with these roles: the sealed volume, so that it need not be
    /// closed again.
    std::optional<SealedVolume> sealed;
    double enclosed = 0;          ///< [model length³]
    std::optional<Message> guess; ///< the error about an ambiguous shape; empty if unambiguous
    /// A given end with holes that have no walls and may extend to a missing end; invalid if there is none.
    /// An open volume with this end as source must be closed with `CloseOptions::holes` set.
    FaceId holed;
    std::size_t ways = 1; ///< number of role candidates that enclose this volume
    /// Null if there is no other sweep direction, or if the user gave the ends.
    std::shared_ptr<const OtherSweeps> others;
    /// The error that no ends were found. If it is set, `closure` is set too, and all faces of `volume` are
    /// walls.
    std::optional<Message> no_roles;
};

/// The sealed volume with the roles of its k-th other sweep. @pre k < others.ways.size()
topology::OpenVolume other_sweep(const OtherSweeps& others, std::size_t k);

/// The voids that some faces of `model` may enclose when no roles are given, likeliest first. Voids that are
/// clearly less likely than the first are left out.
///
/// Each of topology::role_candidates() is sealed; candidates that cannot be sealed are dropped. Two
/// candidates enclose the same void if their volumes are equal within a tolerance and the distance of their
/// void faces is small compared with the size of the void. The sealed skin of each void is then searched for
/// the best sweep direction among those about as likely as the likeliest one. The best one has the fewest
/// expected irregular nodes; among equals, a direction with open ends comes first, then one between given
/// ends, then one between void faces. If a candidate of the given faces has the ends of this direction, the
/// result is the open volume with these roles, not the sealed one. The next three directions are kept, in
/// case the best one cannot be meshed.
///
/// Some hollows have no candidate, because their bottom blends smoothly into their walls, such as a
/// hemisphere or a bore with a round end. Such a hollow is split across the blend; its bottom is the source.
///
/// If a tube has a flat annular floor at one of its two ends, like a counterbore, the source is this floor
/// together with the mouth of the narrower bore.
///
/// Flat faces may close the free loops without being one face for each loop: a face has a hole, or a loop
/// runs around two or three flat faces. The volume that they enclose is a further void.
///
/// Faces that are less than half of the skin of closed bodies, by area, show on which side their void lies:
/// beside the material. If no void is found there, a groove around an axis is read as a full turn; otherwise
/// the voids in the material are returned, with a note if the faces are less than a quarter.
///
/// A void with an ambiguous bent face is dropped if another void has flat faces. If it is the only void, it
/// is kept, and `Reading::guess` describes the ambiguity.
/// @return  empty if no candidate is valid.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
/// @note  O(facets log facets) for each sealed candidate, at most 24. All candidates that only fill flat free
///        loops enclose the same volume; only one of them is sealed.
std::vector<Reading> find_readings(const topology::Model& model, const std::vector<FaceId>& faces,
                                   const RunContext& context = {});

/// The only void of some faces, or the one selected by number.
/// @param number  from 1, as in the error message; 0: requires exactly one void, with an unambiguous shape.
/// @return  the void. If no ends were found but the rims determine the missing faces, the void is returned
///         with `Reading::no_roles` set, and all its faces are walls. If `number` is 0 and several voids
///         differ only in whether holes without walls are covered or extended, a class IV volume is returned
///         whose source is the face with these holes; close() then needs `CloseOptions::holes`.
/// @throw InvalidInput "topology.no_roles"  no ends were found, and without ends the missing faces cannot be
///         closed; instead "topology.sphere", "topology.cone" or "topology.crossing_bores" for these shapes.
///         "topology.roles_ambiguous"  several voids; lists the enclosed volumes. "topology.shape_open"  the
///         shape of a missing face is ambiguous; names the faces next to the missing one.
///         "topology.no_such_reading"  a wrong number.
/// @throw Cancelled
Reading find_reading(const topology::Model& model, const std::vector<FaceId>& faces, int number = 0,
                     const RunContext& context = {});

} // namespace lacuna::closure
