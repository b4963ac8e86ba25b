// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>

namespace lacuna::surface {

/// The size used if none is given.
struct DefaultSize {
    double length = 0; ///< [model length]
    std::string why;   ///< its origin, in words
};

/// Mean length of the facets' sides on the source's rims. On edges without kept nodes, facets show the
/// accuracy of the shape, not the wanted mesh size: sides shorter than a twentieth of the diagonal of the
/// rims' box are replaced by sides of that length.
/// @note  O(points on the rims).
DefaultSize default_size(const topology::OpenVolume& volume);

} // namespace lacuna::surface
