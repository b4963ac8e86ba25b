// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>

#include <string>
#include <vector>

namespace lacuna::closure {

/// A hollow of a solid that is a valid open volume, or a void within it, which may have no ends to sweep
/// between.
struct Cavity {
    std::string kind;          ///< "pocket", "bore", "slot" or "inner void"
    std::vector<FaceId> faces; ///< ascending: the `faces` to name for an open volume
    topology::VolumeClass value = topology::VolumeClass::closed;
    double volume = 0; ///< enclosed once sealed [model length³]
};

/// The cavities of the solids of a model: the hollows of topology::hollows(), each alone and merged with the
/// others that share a whole rim with it, if they have no mouth or find_readings() finds exactly one void. In
/// the order of their first faces.
/// @throw Cancelled
/// @note  One call of find_readings() per hollow.
std::vector<Cavity> cavities(const topology::Model& model, const RunContext& context = {});

} // namespace lacuna::closure
