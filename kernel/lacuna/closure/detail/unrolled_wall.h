// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/detail/axis_rims.h>
#include <lacuna/closure/detail/outline.h>
#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/core/run_context.h>

#include <optional>
#include <vector>

namespace lacuna::closure {

/// The triangulation of a part of a round wall that is unrolled: angle times radius, and height.
geometry::Triangulation triangulate_unrolled(const Outline& outline, double step, const RunContext& context);

/// The wall between two rims with holes, as one face without void edges. The wall is cut open and unrolled.
/// @return  empty if the unrolled wall crosses itself or a hole
std::optional<VoidFilling> fill_round_wall(const topology::Model& model, const RoundRim& from,
                                           const std::vector<topology::EdgeUse>& a,
                                           const std::vector<topology::EdgeUse>& b,
                                           const std::vector<topology::Loop>& holes,
                                           const RunContext& context);

} // namespace lacuna::closure
