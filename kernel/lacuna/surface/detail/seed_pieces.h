// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>

/// Distribution of nodes over a piece of an edge. Internal to this folder.
namespace lacuna::surface {

/// Number of sides that the size requires from the start of a piece to a fraction of its edge, if the size
/// varies along it.
double wanted_at(const SeedPiece& piece, double fraction);

} // namespace lacuna::surface
