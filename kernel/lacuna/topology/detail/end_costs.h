// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/shared/patches.h>

#include <optional>

namespace lacuna::topology {

/// Cost of an end that is bent, in [0, 1]: the unit of all costs of `role_candidates()`.
double bend(const SmoothPatch& end);

/// Cost of two patches as the ends of a sweep.
double cost_of_two_ends(const SmoothPatch& s, const SmoothPatch& t);

/// Cost of the candidate in which all faces are walls. Empty if the faces are not tubes whose free loops
/// can be ends.
std::optional<double> cost_of_no_end(const Model& model);

} // namespace lacuna::topology
