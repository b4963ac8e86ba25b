// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/readings.h>
#include <lacuna/core/run_context.h>

#include <cstddef>
#include <string>
#include <vector>

namespace lacuna::closure {

/// A hollow of a solid that can be used as an open volume, or an inner void. Inner void: a hollow without a
/// mouth. It is listed even if it has no ends to sweep between.
struct Cavity {
    std::string kind;          ///< "pocket", "bore", "slot" or "inner void"
    std::vector<FaceId> faces; ///< the faces to name for an open volume, ascending
    topology::VolumeClass value = topology::VolumeClass::closed;
    double volume = 0; ///< volume enclosed when the cavity is sealed, bodies in it included [model length³]
    bool has_bodies = false; ///< whether `faces` include those of bodies in the cavity
};

/// The cavities of the solids of a model, in the order of their first faces. Candidates are the hollows of
/// topology::hollows(). Hollows that share edges are also merged into one further candidate, which comes
/// before its parts. A candidate is a cavity if it has no mouth, or if find_readings() finds exactly
/// one void. The faces include those of other bodies of the model that lie in the cavity, such as boards in
/// a tray.
/// @throw Cancelled
/// @note  One call of find_readings() per candidate.
std::vector<Cavity> cavities(const topology::Model& model, const RunContext& context = {});

/// The largest cavities, largest first, none a part of another.
/// @throw Cancelled
/// @note  One call of find_readings() per candidate, until `most` cavities are found.
std::vector<Cavity> largest_cavities(const topology::Model& model, std::size_t most,
                                     const RunContext& context = {});

} // namespace lacuna::closure
