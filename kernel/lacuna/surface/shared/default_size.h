// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <string>

namespace lacuna::surface {

/// The size used if none is given.
struct DefaultSize {
    double length = 0; ///< [model length]
    std::string why;   ///< its origin, in words
};

/// Mean length of the facets' sides on the source's rims. On edges without kept nodes, the facets show the
/// accuracy of the shape, not a wanted mesh size. There, sides shorter than a twentieth of the diagonal of
/// the rims' box count as if they had that length.
/// @note  O(points on the rims).
DefaultSize default_size(const topology::OpenVolume& volume);

/// A field of constant value.
SizeField even_size(double length);

/// A field that checks the values of another field before they are used as divisors.
/// @throw InvalidInput "sweep.size"  thrown by the returned field if a value is not a positive length; names
///         the option.
SizeField checked_size(const SizeField& field, const std::string& option);

} // namespace lacuna::surface
