// SPDX-License-Identifier: MIT
#pragma once

#include "bindings/classes.h"
#include "bindings/options.h"

#include <lacuna/quality/shared/metrics.h>

#include <memory>
#include <optional>
#include <vector>

namespace lacuna::lua {

/// The mesh that a Quality of Lua describes; its metrics are measured when they are first asked for.
struct QualitySource {
    quality::Quality quality;
    std::shared_ptr<MeshState> mesh; ///< null: the nodes and cells below
    std::vector<Vec3> nodes;
    std::vector<Hex> hexes; ///< corners
    std::optional<std::vector<quality::MetricSummary>> metrics;
};

/// Push a Quality: a table of the measured values, which prints as text.
/// @param source  index of a `temporary<QualitySource>`
void push_quality(lua_State* L, int source);

/// { min_scaled_jacobian =, mean_scaled_jacobian =, area =, face_area =, quads =, triangles = }
int push_quads_quality(lua_State* L, const fill::FilledShell& shell);

/// The metric that is named at `index`.
quality::Metric read_metric(lua_State* L, int index, const Where& where);

} // namespace lacuna::lua
