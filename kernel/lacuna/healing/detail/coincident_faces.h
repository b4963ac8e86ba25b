// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::healing {

/// Do two faces cover the same place, whichever way they face? By their exact surfaces where both have one,
/// else by their facets, which must then stay within the tolerance of each other.
/// @pre  their borders lie on each other.
bool faces_coincide(const topology::Model& model, const topology::Face& a, const topology::Face& b,
                    double tolerance, const RunContext& context);

} // namespace lacuna::healing
