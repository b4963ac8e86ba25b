// SPDX-License-Identifier: MIT
#pragma once

#include "support/plane_domains.h"

#include <cstdint>

namespace lacuna::bench {

/// A member of a family of outlines that nothing was chosen on.
///
/// A few cells of a grid of uneven columns and rows, as one polygon. Its corners are left, cut off or
/// rounded; its sides have notches, square, pointed or round; some cells have a hole, round, hexagonal or a
/// slot. The whole is turned. `test::family_domain()` shares no generator with it.
/// @param number  of the member, from 0.
test::PlaneDomain held_domain(std::uint32_t seed, int number);

} // namespace lacuna::bench
