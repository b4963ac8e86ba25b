// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::topology {

/// Maximum distance of a face's facets from the true surface, estimated from their angles [model length].
/// O(facets).
double facet_sag(const Model& model, const Face& face);

} // namespace lacuna::topology
