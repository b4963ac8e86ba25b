// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::matching {

/// A chain of wall edges from a vertex of the source rim to a vertex of the target rim.
struct SideLine {
    VertexId source, target;
    std::vector<topology::EdgeUse> uses; ///< from source to target
};

/// Height of each model point on the walls: the harmonic function that is 0 on the source rim and 1 on the
/// target rim. NaN off the walls and on wall parts that do not join both rims.
/// @param lines  known side lines: their points get the share of the line's length as height. Open walls that
///               twist or bend need this, because their free borders would otherwise tilt the level lines.
std::vector<double> wall_heights(const topology::OpenVolume& volume, const std::vector<SideLine>& lines = {},
                                 const RunContext& context = {});

/// How steeply an edge climbs: its height difference, divided by the largest one possible along its length.
/// It is 1 straight up and 0 along a level line, positive from `from` to `to`, and NaN where a height is NaN.
double climb(const topology::Model& model, EdgeId edge, const std::vector<double>& heights,
             const std::vector<double>& gradient);

/// Gradient magnitude of the heights at each model point, for climb() [1 / model length].
std::vector<double> height_gradient(const topology::OpenVolume& volume, const std::vector<double>& heights);

/// The side lines of a volume's walls. Edges that climb by less than half their length separate the storeys
/// of a stack and belong to no side line. Side lines share no vertices: of two that would, the shorter is
/// kept.
std::vector<SideLine> side_lines(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::matching
