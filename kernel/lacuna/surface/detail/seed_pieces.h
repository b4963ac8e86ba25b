// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/seeds.h>

/// How nodes are spread over a piece of an edge. Internal to this folder.
namespace lacuna::surface {

/// Sides wanted from a piece's start to a fraction of its edge, where they change along it.
double wanted_at(const SeedPiece& piece, double fraction);

} // namespace lacuna::surface
