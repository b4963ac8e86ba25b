// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/model.h>

namespace lacuna::healing {

/// Whether two faces coincide, in either orientation. Their exact surfaces are compared if both have one,
/// otherwise their facets, which must stay within the tolerance of each other.
/// @pre  their borders coincide.
bool faces_coincide(const topology::Model& model, const topology::Face& a, const topology::Face& b,
                    double tolerance, const RunContext& context);

} // namespace lacuna::healing
