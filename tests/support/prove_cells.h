// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/quality/quality.h>

#include <span>

namespace lacuna::test {

/// What `quality::prove()` proves of a swept mesh, found from the cells alone: cells of any origin.
/// @param skin  where not empty, quads and triangles that must be exactly the skin, in any order and
///              direction.
quality::Proof prove_cells(std::span<const Vec3> nodes, std::span<const Hex> hexes,
                           std::span<const Quad> skin = {}, double min_scaled_jacobian = 0,
                           const RunContext& context = {});

} // namespace lacuna::test
