// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <optional>
#include <vector>

/// Holes of given ends that have no walls: whether they go through changes what is enclosed. Internal to this
/// folder.
namespace lacuna::closure {

/// A hole of a given end along whose rim no wall stands.
struct EndHole {
    topology::Role end; ///< source or target
    FaceId face;        ///< one beside it
    topology::Rim rim;
};

/// The holes without walls of both ends. Of the rims of a connected part of an end the one that encloses most
/// is its outline, and the others are its holes.
std::vector<EndHole> holes_without_walls(const topology::OpenVolume& volume);

/// Give each hole a void face in the end's surface, which is a part of that end.
/// @throw NotClosed  no face fits a hole's rim.
std::vector<FaceId> cover_holes(topology::OpenVolume& volume, const std::vector<EndHole>& holes,
                                const RunContext& context);

/// What a volume without a target encloses [model length³]; nothing where it cannot be sealed so.
struct HoleVolumes {
    std::optional<double> covered, through;
};
HoleVolumes hole_volumes(const topology::OpenVolume& volume, const CloseOptions& options,
                         const RunContext& context);

} // namespace lacuna::closure
