// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::matching {

/// A chain of wall edges that rises from a vertex of the source rim to one of the target rim.
struct SideLine {
    VertexId source, target;
    std::vector<topology::EdgeUse> uses; ///< from source to target
};

/// How far up the walls each model point lies: the harmonic function that is 0 on the source rim and 1 on the
/// target rim. NaN off the walls and on wall parts that do not join both rims.
/// @param lines  side lines, where they are known: the share of their length below a point is its height.
///               With open walls this keeps level what twists and bends; the free sides alone would let it
///               lean.
std::vector<double> wall_heights(const topology::OpenVolume& volume, const std::vector<SideLine>& lines = {},
                                 const RunContext& context = {});

/// How steeply an edge climbs: its rise over the most it could rise along its length, 1 straight up, 0
/// along a level line. Signed: positive from `from` to `to`. NaN where the heights are.
double climb(const topology::Model& model, EdgeId edge, const std::vector<double>& heights,
             const std::vector<double>& gradient);

/// Size of the heights' gradient at each model point, for climb() [1 / model length].
std::vector<double> height_gradient(const topology::OpenVolume& volume, const std::vector<double>& heights);

/// The side lines of a volume's walls. Edges that climb by less than half their length are level, parts of a
/// stack, and no side line uses them. No two lines share a vertex: the shorter stays.
std::vector<SideLine> side_lines(const topology::OpenVolume& volume, const RunContext& context = {});

} // namespace lacuna::matching
