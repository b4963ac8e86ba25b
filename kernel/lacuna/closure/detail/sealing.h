// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <optional>
#include <utility>

namespace lacuna::closure {

/// The first edge that does not belong to two faces that use it in opposite directions.
std::optional<EdgeId> unpaired_edge(const topology::Model& model);

/// A void face and another face (void or given) with crossing facets.
using FaceCrossing = std::pair<FaceId, FaceId>;

/// The first pair of a void face and another face that cross; empty if none do. Facets that only touch at
/// shared points do not cross.
std::optional<FaceCrossing> first_crossing(const topology::OpenVolume& volume, const RunContext& context);

} // namespace lacuna::closure
