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

} // namespace lacuna::closure
