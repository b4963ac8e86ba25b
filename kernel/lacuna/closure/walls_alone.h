// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The one void that walls named alone are, where they are open and some that hang together are no tube with
/// a free loop at either side, as what is missing between two ends needs: walls with a bottom, or with three
/// mouths. A note says what they are read as.
/// @param take_guess  also where its shape is a guess
/// @return  nothing where they are tubes, where they have branches, which are cut, and where find_readings()
///          has no or several readings of them.
/// @throw InvalidInput  as open_volume(). Cancelled.
std::optional<Reading> read_walls_alone(const topology::Model& model, const std::vector<FaceId>& walls,
                                        bool take_guess, const RunContext& context = {});

} // namespace lacuna::closure
