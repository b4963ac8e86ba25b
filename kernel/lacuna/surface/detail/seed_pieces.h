// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/shared/seeds.h>

/// Distribution of nodes over a piece of an edge. Internal to this folder.
namespace lacuna::surface {

/// Number of sides that the size requires between the start of a piece and a fraction of its edge. @pre the
/// size varies along the piece
double wanted_at(const SeedPiece& piece, double fraction);

} // namespace lacuna::surface
