// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/auto_roles.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A volume as it is sealed where nothing is asked for: close() with this match and no options gives just
/// that.
struct SealedVolume {
    matching::Match match;
    topology::OpenVolume volume;
    Closure closure;
};

/// A void, sealed, and the ways to sweep it besides the one a reading takes, the best first.
struct OtherSweeps {
    topology::OpenVolume volume;
    Closure closure;
    std::vector<topology::RoleCandidate> ways; ///< in faces of `volume`
};

/// A void that some faces can be read as, ready to be swept the best way.
struct Reading {
    topology::RoleCandidate roles; ///< in faces of the model
    topology::OpenVolume volume;   ///< with those roles
    topology::Classification classification;
    /// Set where an end is a face that only closing makes: `volume` is sealed then.
    std::optional<Closure> closure;
    /// Set where `volume` is open and was sealed as it is to be read: that need not be done again.
    std::optional<SealedVolume> sealed;
    double enclosed = 0; ///< [model length³]
    std::string guess;   ///< what of its shape nothing given tells, in words; empty where all is told
    /// A given end with holes that have no walls, and may go through to an end that is missing; not valid
    /// where there is none. An open volume with this as its source is to be closed by `CloseOptions::holes`.
    FaceId holed;
    std::size_t ways = 1; ///< how many readings of the faces enclose it
    /// Null where there is no other way, and where the ends were given as such.
    std::shared_ptr<const OtherSweeps> others;
};

/// The sealed volume with the roles of its k-th other way. @pre k < others.ways.size()
topology::OpenVolume other_sweep(const OtherSweeps& others, std::size_t k);

/// The voids that some faces of `model` can be read as without being told roles, the likeliest first; all are
/// about as likely.
///
/// Readings as topology::role_candidates() has them are sealed, each by itself; those that do not seal drop
/// out. Two readings are one void where their volumes agree and no point of one's void faces lies further
/// than a small share of its size from the other's: given faces are the same in both. A void is then read
/// anew, as the closed skin it is, and swept the best way: of those about as likely as the likeliest the one
/// with the fewest irregular nodes to expect, and of these the one with the most even cells. That way is kept
/// open where a reading of the given faces says the same. The next three are kept as well, for who finds that
/// the first cannot be meshed.
///
/// A hollow that has no such reading, because its bottom goes over into its walls smoothly, is split across
/// where it bends: a hemisphere, a bore with a round end. Its bottom is the source then.
///
/// A tube with a flat floor round a narrower bore at one of its two ends, as a counterbore's wall and ledge
/// are, is read from that floor and the bore's mouth in it.
///
/// Free loops that flat faces close, though not one each (one has a hole, or a loop lies in two planes), are
/// one more void. So is a channel without its ends and a wall where nothing else tells: the free loop's runs
/// in two planes are its ends where they are alike.
///
/// A void whose bends nothing tells gives way to one with flat faces, and is a guess where it stands alone:
/// `Reading::guess` says what is not told.
/// @return  empty where no reading passes.
/// @throw InvalidInput  faces that cannot be oriented. Cancelled.
/// @note  O(facets log facets) for each reading that is sealed; no more than 24 are. Readings that only fill
///        flat free loops enclose the same, and of those one is sealed.
std::vector<Reading> find_readings(const topology::Model& model, const std::vector<FaceId>& faces,
                                   const RunContext& context = {});

/// The one void that some faces are, or the one that is asked for by its number.
/// @param number  from 1, as the message counts them; 0: there must be one only, whose shape is no guess.
/// @return  with 0, where all that is left open is whether holes without walls go through: the face that has
///          them as the source of a volume of class IV, which close() refuses unless it is told.
/// @throw InvalidInput "topology.no_roles", or "topology.sphere", "topology.torus", "topology.cone",
///        "topology.crossing_bores" for these shapes, "topology.roles_ambiguous" (lists what each would
///        enclose), "topology.shape_open" (names the faces round what is missing),
///        "topology.no_such_reading". Cancelled.
Reading find_reading(const topology::Model& model, const std::vector<FaceId>& faces, int number = 0,
                     const RunContext& context = {});

} // namespace lacuna::closure
