// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>

/// Distribution of nodes over a piece of an edge. Internal to this folder.
namespace lacuna::surface {

/// Cumulative wanted sides from a piece's start to a fraction of its edge, if they vary along it.
double wanted_at(const SeedPiece& piece, double fraction);

} // namespace lacuna::surface
