// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// A hollow whose bottom goes over into its walls smoothly, parted where it bends.
std::optional<Reading> read_bowl(const topology::Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context);

/// A tube with one end open all over and in the other a floor round a narrower bore: a counterbore without
/// the bore. The floor is the source, with the flat face that closes the bore.
std::optional<Reading> read_floor(const topology::Model& model, const std::vector<FaceId>& faces,
                                  const RunContext& context);

} // namespace lacuna::closure
