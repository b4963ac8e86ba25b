// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/sealed_voids.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// Sweep directions of a closed skin, best first: those with the fewest irregular nodes, and among them those
/// with the most even cells. Directions that cannot be swept, even after cuts at steps, are left out.
std::vector<topology::RoleCandidate> best_sweeps(const topology::Model& skin, const RunContext& context);

/// Search the unlikely candidates too. Return the first one for which `suits` is true, followed by those
/// about as likely, without calling `suits` for them; empty if none suits.
/// @param most  number of candidates that are checked in full
std::vector<topology::RoleCandidate> less_likely(
    const topology::Model& model, const std::vector<FaceId>& faces, std::size_t most,
    const std::function<bool(const topology::RoleCandidate&)>& suits, const RunContext& context);

/// The class of the given faces alone, with their roles on a sealed skin.
topology::Classification class_as_given(const topology::Model& model, const topology::Roles& roles);

/// Give the faces of a sealed volume the roles of one sweep direction.
void set_ends(topology::OpenVolume& volume, const topology::Roles& roles);

/// The reading of a void with its best sweep direction. Empty if a likelier void has the same ends.
/// @param likelier  all voids, `found` among them, the likeliest first
std::optional<Reading> read(const topology::Model& model, const std::vector<Void>& likelier, Void& found,
                            const RunContext& context);

/// If a given face has holes that may or may not extend to a missing end, record the face and the ambiguity
/// in the reading.
/// @param through  the end that was moved with its holes, if there is one
/// @param given    the faces of `model` that come first in the sealed volume
void note_hole(const topology::Model& model, FaceId through, const std::vector<FaceId>& given,
               const Sealed& sealed, Reading& reading);

/// An open volume of class IV whose source is a face with holes, if only these holes, which have no walls,
/// make the readings ambiguous. Otherwise empty.
std::optional<Reading> leave_holes_open(const topology::Model& model, const std::vector<Reading>& readings,
                                        const std::vector<FaceId>& faces, const RunContext& context);

} // namespace lacuna::closure
