// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The only void enclosed by walls given without ends, if they are open and a connected part is no tube with
/// a free loop on either side, such as walls with a bottom or with three mouths. A note reports the roles.
/// @param take_guess  also if the shape is ambiguous
/// @return  empty if all parts are tubes, if they have branches (which are cut instead), or if
///          find_readings() finds none or several.
/// @throw InvalidInput  as open_volume(). Cancelled.
std::optional<Reading> read_walls_alone(const topology::Model& model, const std::vector<FaceId>& walls,
                                        bool take_guess, const RunContext& context = {});

} // namespace lacuna::closure
