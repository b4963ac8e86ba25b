// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The void that walls enclose if the user gave no ends. The walls must be open. At least one connected part
/// must not be a tube with a free loop at either end, for example walls with a bottom or with three mouths. A
/// note reports the roles.
/// @param accept_ambiguous  whether to accept an ambiguous shape
/// @return  empty in any of these cases:
/// - all parts are tubes, or bores of the walls cross each other;
/// - the walls have branches (the volume is then cut at its branches instead);
/// - find_readings() does not find exactly one void with ends;
/// - the shape of the void is ambiguous, and `accept_ambiguous` is not set.
/// @throw InvalidInput  the errors of open_volume().
/// @throw Cancelled
std::optional<Reading> read_walls_alone(const topology::Model& model, const std::vector<FaceId>& walls,
                                        bool accept_ambiguous, const RunContext& context = {});

} // namespace lacuna::closure
