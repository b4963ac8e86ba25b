// SPDX-License-Identifier: MIT
#pragma once

#include "plane_domains.h"

#include <cstdint>

namespace lacuna::test {

/// A member of a family of outlines made from a seed: what mechanical parts look like, at random proportions.
///
/// The kinds take turns: polygons with rounded or hollow corners; L, T, U and plus shapes; plates with round
/// holes; plates with slots; gears with a bore; smooth loops; rings; polygons with polygonal holes. All are
/// turned by a random angle. Members of one seed have nothing in common with those of another: one seed is
/// for choosing, another for measuring what was chosen.
/// @param number  of the member, from 0.
PlaneDomain family_domain(std::uint32_t seed, int number);

/// The member with nodes on its outline, for 100 to 1500 quads.
SeededDomain family_region(std::uint32_t seed, int number);

} // namespace lacuna::test
