// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::healing {

/// Do two faces coincide, in either orientation? Compared by their exact surfaces if both have one, otherwise
/// by their facets, which must then stay within the tolerance of each other.
/// @pre  their borders coincide.
bool faces_coincide(const topology::Model& model, const topology::Face& a, const topology::Face& b,
                    double tolerance, const RunContext& context);

} // namespace lacuna::healing
