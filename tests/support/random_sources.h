// SPDX-License-Identifier: MIT
#pragma once

#include "support/source_family.h"

#include <cstdint>

namespace lacuna::test {

/// A board of uneven cells, some missing at its rim and some with a round hole, whose cells are put together
/// to faces at random; flat, or bent as a cylinder, a dome, a saddle or a wave.
///
/// A member of a family that nothing was chosen on. `least_irregular` is -1: by the mesh's own rim.
FamilySource random_source(std::uint32_t seed, int number, int facets = 12);

} // namespace lacuna::test
