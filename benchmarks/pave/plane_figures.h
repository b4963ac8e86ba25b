// SPDX-License-Identifier: MIT
#pragma once

/// What a mesh of an outline is judged by besides its quality: irregular nodes against topology, symmetry.

#include "support/plane_domains.h"

#include <span>
#include <vector>

namespace lacuna::bench {

/// `quads::least_irregular()` of an outline, whose corners are where its curves meet: one within 15 % of a
/// right angle of half way between two numbers of quads has either.
int least_irregular(const test::PlaneDomain& domain);
/// The same by the angles of a mesh's own rim.
int least_irregular(std::span<const double> angles, int euler);

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
