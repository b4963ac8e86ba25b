// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::healing {

/// Whether two faces coincide within the tolerance, in either orientation. If both have an exact surface, the
/// surfaces are compared, otherwise the facets.
/// @pre  the borders of both faces coincide.
bool faces_coincide(const topology::Model& model, const topology::Face& a, const topology::Face& b,
                    double tolerance, const RunContext& context);

} // namespace lacuna::healing
