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
/// @param take_guess  whether to accept an ambiguous shape
/// @return  empty if all parts are tubes, if the walls have branches (the volume is then cut at its branches
///          instead), or if find_readings() finds no void or several.
/// @throw InvalidInput  the errors of open_volume().
/// @throw Cancelled
std::optional<Reading> read_walls_alone(const topology::Model& model, const std::vector<FaceId>& walls,
                                        bool take_guess, const RunContext& context = {});

} // namespace lacuna::closure
