// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/ids.h>

#include <string>

/// What all steps of an imprint hold to. Internal to this folder.
namespace lacuna::topology {
struct Model;
}

namespace lacuna::surface {

/// Edges of both ends nearer than this share of the size asked for are one: no quad fits between them. A
/// choice, not a measurement.
inline constexpr double kOneEdge = 0.4;

/// @throw NotSweepable "surface.not_imprinted"  names the edge.
[[noreturn]] void refuse_imprint(const topology::Model& model, EdgeId edge, const std::string& why);

} // namespace lacuna::surface
