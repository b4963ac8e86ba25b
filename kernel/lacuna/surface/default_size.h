// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/topology/open_volume.h>

#include <string>

namespace lacuna::surface {

/// The size where none is asked for.
struct DefaultSize {
    double length = 0; ///< [model length]
    std::string why;   ///< what it was taken from, in words
};

/// Mean length of the facets' sides on the source's rims. On edges that keep no nodes facets tell how exact a
/// shape is, not how fine a mesh is wanted: such an edge counts with sides of a twentieth of the diagonal of
/// the rims' box where its own are shorter.
/// @note  O(points on the rims).
DefaultSize default_size(const topology::OpenVolume& volume);

} // namespace lacuna::surface
