// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/sealed_voids.h>

#include <functional>
#include <optional>
#include <vector>

namespace lacuna::closure {

/// Sweep directions of a closed skin, best first: those with the fewest irregular nodes, and among these the
/// likeliest. Directions whose ends are at several heights are left out if the volume cannot be cut at the
/// steps.
std::vector<topology::RoleCandidate> best_sweeps(const topology::Model& skin, const RunContext& context);

/// Search the unlikely candidates too.
/// @return  the first one for which `suits` is true, followed by those about as likely, for which `suits` is
///         not called; empty if none suits.
/// @param options  their margin does not count
std::vector<topology::RoleCandidate> less_likely(
    const topology::Model& model, const std::vector<FaceId>& faces, topology::RoleOptions options,
    const std::function<bool(const topology::RoleCandidate&)>& suits, const RunContext& context);

/// The class of the open volume that the faces named in `roles` form without void faces.
topology::Classification class_as_given(const topology::Model& model, const topology::Roles& roles);

/// Set the roles of a sealed volume: its ends are those of `roles`, and all other faces are walls.
void set_ends(topology::OpenVolume& volume, const topology::Roles& roles);

/// The reading of the void `found` with its best sweep direction. Empty if a likelier void has the same ends.
/// @param likelier  all voids, the likeliest first; `found` is one of them. The voids before `found` are
///         likelier.
std::optional<Reading> read(const topology::Model& model, const std::vector<Void>& likelier, Void& found,
                            const RunContext& context);

/// If it is ambiguous whether holes of a given face extend to a missing end, record the face in
/// `Reading::holed` and the error in `Reading::guess`.
/// @param through  the given end that was moved together with its holes; invalid if there is none
/// @param given    the faces of `model` that come first in the sealed volume
void note_hole(const topology::Model& model, FaceId through, const std::vector<FaceId>& given,
               const Sealed& sealed, Reading& reading);

/// An open volume of class IV whose source is a face with holes without walls. Empty unless each reading
/// encloses the volume with these holes covered or the volume with the holes extended.
std::optional<Reading> leave_holes_open(const topology::Model& model, const std::vector<Reading>& readings,
                                        const std::vector<FaceId>& faces, const RunContext& context);

} // namespace lacuna::closure
