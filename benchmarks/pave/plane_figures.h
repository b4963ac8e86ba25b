// SPDX-License-Identifier: MIT
#pragma once

/// What a mesh of an outline is judged by besides its quality: irregular nodes against topology, symmetry.

#include "support/plane_domains.h"

#include <span>
#include <vector>

namespace lacuna::bench {

/// The least number of irregular interior nodes that topology allows, of three and of five quads.
///
/// The sum rule: over interior nodes the sum of 4 − quads, and over boundary nodes the sum of 2 − quads, are
/// 4 times the Euler number together. Boundary nodes have the quads that right angles fit in their angle; one
/// within 15 % of half way between two numbers has either, whichever is better. Nodes of six quads, which
/// count twice, are not reckoned with.
/// @param angles  inside the region, at its boundary nodes; straight ones may be left out [radian]
/// @param euler   2 less the number of loops
int least_irregular(std::span<const double> angles, int euler);

/// The same of an outline, whose corners are where its curves meet.
int least_irregular(const test::PlaneDomain& domain);

/// A map of the plane onto itself about a point: p → centre + turn · (p − centre).
struct Symmetry {
    Vec2 centre;
    Eigen::Matrix2d turn;
};

/// The turns and reflections other than the identity that take an outline to itself, with the ends of its
/// curves: a circle of four arcs has those of a square.
std::vector<Symmetry> symmetries_of(const test::PlaneDomain& domain);

/// How far points are from their own images at most: from the image of each to the nearest point.
double symmetry_error(std::span<const Vec2> points, std::span<const Symmetry> symmetries);

} // namespace lacuna::bench
