// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/region.h>

namespace lacuna::test {

/// A plain mesher of planar regions, for tests that need one and no Gmsh: every other boundary node makes
/// triangles, each cut in three. Loops of an odd number of nodes are refused; corners should stand at even
/// places of their loop.
quads::PlanarQuads midpoint_quads(const quads::PlanarRegion& region, const RunContext& context);

} // namespace lacuna::test
