// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::topology {

/// Do two faces cover the same place, whichever way they face? By their exact surfaces where both have one,
/// else by their facets, which must then stay within the tolerance of each other.
/// @pre  their borders lie on each other.
bool faces_coincide(const Model& model, const Face& a, const Face& b, double tolerance);

} // namespace lacuna::topology
