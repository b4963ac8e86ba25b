// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <optional>
#include <vector>

namespace lacuna::matching {

/// A chain of wall edges from a vertex of the source rim to a vertex of the target rim.
struct SideLine {
    VertexId source, target;
    std::vector<topology::EdgeUse> uses; ///< from source to target
};

/// Height of each model point on the walls: the harmonic function that is 0 on the source rim and 1 on the
/// target rim. NaN for points that are on no wall, and on connected parts of the walls that do not join both
/// rims.
/// @param lines  known side lines. The height of a point on a side line is set to the share of the line's
///               length below the point. This matters for walls that do not form a ring and twist or bend:
///               otherwise their free borders would tilt the level lines.
std::vector<double> wall_heights(const topology::OpenVolume& volume, const std::vector<SideLine>& lines = {},
                                 const RunContext& context = {});

/// How steeply an edge climbs: the height difference from `from` to `to`, divided by the largest difference
/// possible along the edge's length. 1: straight up; 0: along a level line; negative: down; NaN if a height
/// is NaN.
double climb(const topology::Model& model, EdgeId edge, const std::vector<double>& heights,
             const std::vector<double>& gradient);

/// Gradient magnitude of the heights at each model point, for climb() [1 / model length].
std::vector<double> height_gradient(const topology::OpenVolume& volume, const std::vector<double>& heights);

/// The given wall that continues over a void face. The void face covers a hole of this wall, and the hole's
/// rim is no rectangle, so that rows and columns cannot follow it. Empty: no wall continues.
std::optional<FaceId> continued_wall(const topology::Model& model, FaceId face);

/// The side lines of a volume's walls. Edges whose climb() is at most 0.5 are not used: they separate walls
/// that are stacked on each other. Nor are the edges round a void face over which a wall continues. Side
/// lines share no vertices: if two lines would share one, the line of lower cost (length divided by climb) is
/// kept, and the other one takes another path.
std::vector<SideLine> side_lines(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::matching
