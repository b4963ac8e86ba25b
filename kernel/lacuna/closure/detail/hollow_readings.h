// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The reading of a hollow whose bottom blends smoothly into its walls; the blend is split.
std::optional<Reading> read_bowl(const topology::Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context);

/// The reading of a tube with one fully open end and, at the other, a floor round a narrower bore: a
/// counterbore without its bore. The floor is the source, together with the flat face that closes the bore.
std::optional<Reading> read_floor(const topology::Model& model, const std::vector<FaceId>& faces,
                                  const RunContext& context);

} // namespace lacuna::closure
