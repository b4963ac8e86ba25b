// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/sealed_voids.h>
#include <lacuna/closure/readings.h>
#include <lacuna/topology/shared/hollows.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// As the function without `bodies`, for many voids of one model.
/// @param bodies  of the model
std::vector<Reading> find_readings(const topology::Model& model, const std::vector<FaceId>& faces,
                                   const topology::Bodies& bodies, const RunContext& context);

/// The reading of a hollow whose bottom blends smoothly into its walls: the bottom is cut from the walls
/// across the blend (`part_bowl()`). Empty for other faces.
std::optional<Reading> read_bowl(const topology::Model& model, const std::vector<FaceId>& faces,
                                 const RunContext& context);

/// The reading of a counterbore without its bore: a tube that is open at one end and has an annular floor at
/// the other. The source is the floor together with the flat face that closes the mouth of the bore. Empty
/// for other faces.
std::optional<Reading> read_floor(const topology::Model& model, const std::vector<FaceId>& faces,
                                  const MayEnclose& may_enclose, const RunContext& context);

} // namespace lacuna::closure
