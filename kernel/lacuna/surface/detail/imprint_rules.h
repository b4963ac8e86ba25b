// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>

/// Rules common to all steps of an imprint. Internal to this folder.
namespace lacuna::topology {
struct Model;
}

namespace lacuna::surface {

/// Edges of both ends closer than this share of the size are merged: no quad fits between them. Heuristic.
inline constexpr double kOneEdge = 0.4;

/// Inner loops of both ends are matched if they differ by less than this share of the loop's radius. They
/// then still overlap by more than half. Heuristic.
inline constexpr double kAlikeLoops = 0.5;

/// @throw NotSweepable "surface.not_imprinted"  names the edge.
[[noreturn]] void refuse_imprint(const topology::Model& model, EdgeId edge, const char* why);

} // namespace lacuna::surface
