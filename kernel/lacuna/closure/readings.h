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

/// A volume sealed with default options: close() with this match and no options gives the same result.
struct SealedVolume : Closed {
    matching::Match match;
};

/// A sealed void and its other sweep directions, best first; the direction that its reading uses is not among
/// them. For a hollow whose reading splits the bottom from the walls, `ways` is empty and the faces of
/// `volume` are not split.
struct OtherSweeps : Closed {
    std::vector<topology::RoleCandidate> ways; ///< role candidates; they name faces of `volume`
};

/// A void that some faces enclose, ready to be swept in its best direction.
struct Reading {
    topology::RoleCandidate roles; ///< name faces of the model
    topology::OpenVolume volume;   ///< with those roles
    topology::Classification classification;
    /// Set if an end is a void face; `volume` is then sealed.
    std::optional<Closure> closure;
    /// Set if `volume` is open: its sealed state, so that it need not be closed again.
    std::optional<SealedVolume> sealed;
    double enclosed = 0;          ///< [model length³]
    std::optional<Message> guess; ///< the error about an ambiguous shape; empty if unambiguous
    /// A given end with holes without walls that may extend to a missing end; invalid if there is none. An
    /// open volume with this end as source must be closed with `CloseOptions::holes`.
    FaceId holed;
    std::size_t ways = 1; ///< number of candidates for roles that enclose this volume
    /// Null if there is no other sweep direction, or if the user gave the ends.
    std::shared_ptr<const OtherSweeps> others;
    /// Why no ends were found. If set, `closure` is set too, and all faces of `volume` are walls.
    std::optional<Message> no_roles;
};

/// The sealed volume with the roles of its k-th other sweep. @pre k < others.ways.size()
topology::OpenVolume other_sweep(const OtherSweeps& others, std::size_t k);

/// The voids that some faces of `model` may enclose when no roles are given, likeliest first. Voids that are
/// clearly less likely than the first are left out.
///
/// Each of topology::role_candidates() is sealed; those that do not seal are dropped. Two candidates enclose
/// the same void if their volumes agree and their void faces are close together, compared with their size.
/// Each void is then analysed again as a closed skin and swept in its best direction: of the candidates about
/// as likely as the likeliest, the one with the fewest expected irregular nodes, then the one with the most
/// even cells. The volume stays open if a candidate of the given faces has the same roles. The next three
/// directions are kept for when the first cannot be meshed.
///
/// A hollow without such a candidate, because its bottom blends smoothly into its walls (a hemisphere, a bore
/// with a round end), is split across the blend; its bottom is the source.
///
/// For a tube with a flat annular floor at one of its two ends, such as a counterbore's wall and ledge, the
/// source is that floor together with the mouth of the narrower bore.
///
/// If flat faces close the free loops, but not with one face for each loop (a face has a hole, or a loop lies
/// in two planes), that closing is a further void. A channel that lacks its ends and one wall is closed only
/// if no unambiguous void was found: its ends are the planar parts of its free loop, which must be congruent.
///
/// A void with an ambiguous bent face is dropped if there is one with flat faces; if it is the only void, it
/// is kept, and `Reading::guess` describes the ambiguity.
/// @return  empty if no candidate is valid.
/// @throw InvalidInput  the faces cannot be oriented.
/// @throw Cancelled
/// @note  O(facets log facets) for each sealed candidate, at most 24. Candidates that only fill flat free
///        loops enclose the same volume, so only one of them is sealed.
std::vector<Reading> find_readings(const topology::Model& model, const std::vector<FaceId>& faces,
                                   const RunContext& context = {});

/// The only void of some faces, or the one selected by number.
/// @param number  from 1, as in the error message; 0: there must be exactly one void, with an unambiguous
///         shape.
/// @return  the void. A void without ends to sweep between, whose rims determine its missing faces, has
///         `no_roles`. If `number` is 0 and only holes without walls make the choice ambiguous, the result is
///         a class IV volume whose source is the face with these holes; close() then needs
///         `CloseOptions::holes`.
/// @throw InvalidInput "topology.no_roles"  no ends were found; instead "topology.sphere", "topology.cone" or
///         "topology.crossing_bores" for these shapes. "topology.roles_ambiguous"  several voids; lists the
///         enclosed volumes. "topology.shape_open"  a missing face of ambiguous shape; names the faces next
///         to it. "topology.no_such_reading"  a wrong number.
/// @throw Cancelled
Reading find_reading(const topology::Model& model, const std::vector<FaceId>& faces, int number = 0,
                     const RunContext& context = {});

} // namespace lacuna::closure
