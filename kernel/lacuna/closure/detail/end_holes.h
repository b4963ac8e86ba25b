// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/close.h>

#include <optional>
#include <vector>

/// Holes without walls in given ends. The enclosed volume depends on whether such a hole is covered or
/// extended to the other end. Internal to this folder.
namespace lacuna::closure {

/// A hole of a given end with no wall along its rim.
struct EndHole {
    topology::Role end; ///< source or target
    FaceId face;        ///< a face of the end at the hole's rim
    topology::Rim rim;
};

/// The holes without walls of both ends. Of the rims of a connected part of an end, the one that encloses the
/// largest area is its outline, and the others are holes.
std::vector<EndHole> holes_without_walls(const topology::OpenVolume& volume);

/// For each rim of the source, the share of its edges without a wall.
std::vector<double> shares_without_walls(const topology::OpenVolume& volume);

/// Close each hole by a void face in the end's surface. The void face becomes part of that end.
/// @throw NotClosed  no face fits a hole's rim.
std::vector<FaceId> cover_holes(topology::OpenVolume& volume, const std::vector<EndHole>& holes,
                                const RunContext& context);

/// The two volumes that a volume without a target may enclose [model length³]: `covered` with its holes
/// covered, `through` with its holes extended to the target. Empty if the closing fails.
struct HoleVolumes {
    std::optional<double> covered, through;
};
HoleVolumes hole_volumes(const topology::OpenVolume& volume, const CloseOptions& options,
                         const RunContext& context);

} // namespace lacuna::closure
