// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/steps.h>
#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <cstddef>
#include <vector>

namespace lacuna::closure {

/// A rim of an end where all walls lead away from the opposite end.
struct Hanging {
    std::size_t part = 0; ///< index of the part of the end
    topology::Rim rim;
};

/// Steps at the rims of an end.
struct Steps {
    std::vector<std::vector<FaceId>> parts; ///< connected parts of the end
    std::vector<Hanging> closed;            ///< rims at which all walls lead away from the opposite end
    std::vector<FaceId> risers;             ///< walls at steps whose rim also has other walls
};

/// Extrude void faces from the rims in `Steps::closed` of one end up to the opposite end, whose faces are
/// split there, and separate the pieces.
/// @param stepped  the end with the steps.
std::vector<StepPiece> cut_below_rims(const topology::OpenVolume& volume, topology::Role stepped, Steps steps,
                                      const RunContext& context);

} // namespace lacuna::closure
