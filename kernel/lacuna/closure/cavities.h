// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>

#include <string>
#include <vector>

namespace lacuna::closure {

/// A hollow of a solid that can be read as an open volume.
struct Cavity {
    std::string kind;          ///< "pocket", "bore", "slot" or "inner void"
    std::vector<FaceId> faces; ///< rising: what `faces` of an open volume names
    topology::VolumeClass value = topology::VolumeClass::closed;
    double volume = 0; ///< enclosed once sealed [model length³]
};

/// The cavities of the solids of a model: hollows by topology::hollows(), alone and with those whose whole
/// rim they share, that find_readings() reads as one void. In the order of their first faces.
/// @throw Cancelled
/// @note  A reading for each hollow.
std::vector<Cavity> cavities(const topology::Model& model, const RunContext& context = {});

} // namespace lacuna::closure
