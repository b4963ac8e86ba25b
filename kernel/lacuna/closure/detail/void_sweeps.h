// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/sealed_voids.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The ways to sweep a closed skin about as likely as the likeliest that can be cut where it has to be: those
/// with the fewest irregular nodes first, and of these the ones with the most even cells.
std::vector<topology::RoleCandidate> best_sweeps(const topology::Model& skin, const RunContext& context);

/// The class by which the given faces alone go, with their roles on a sealed skin.
topology::Classification class_as_given(const topology::Model& model, const topology::Roles& roles);

/// Give the faces of a sealed volume the roles of one way to sweep it.
void set_ends(topology::OpenVolume& volume, const topology::Roles& roles);

/// A void, to be swept the best way. Nothing where a likelier void is what these ends enclose.
/// @param likelier  the voids of which `found` is one, the likeliest first
std::optional<Reading> read(const topology::Model& model, const std::vector<Void>& likelier, Void& found,
                            const RunContext& context);

/// Say in a reading whether the holes of a given face may go through to an end that is missing.
/// @param through  the end that was moved with its holes, if one was
/// @param given    the faces of `model` that are the first of what was sealed
void note_hole(const topology::Model& model, FaceId through, const std::vector<FaceId>& given,
               const Sealed& sealed, Reading& reading);

/// Where all that readings of some faces leave open is whether holes without walls go through: the face that
/// has them as the source of a volume of class IV, open.
std::optional<Reading> leave_holes_open(const topology::Model& model, const std::vector<Reading>& readings,
                                        const std::vector<FaceId>& faces, const RunContext& context);

} // namespace lacuna::closure
