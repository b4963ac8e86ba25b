// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

#include <string>

namespace lacuna::surface {

/// The size that is used if the user gives none.
struct DefaultSize {
    double length = 0; ///< [model length]
    std::string why;   ///< explanation for the user
};

/// Mean length of the facets' sides on the source's rims. If the nodes of an edge are not kept, the length of
/// its facets shows the accuracy of the shape, not the wanted mesh size. A side on such an edge is therefore
/// taken to be at least a twentieth of the diagonal of the rims' bounding box.
/// @note  O(points on the rims).
DefaultSize default_size(const topology::OpenVolume& volume);

/// A field of constant value.
SizeField even_size(double length);

/// A size field that checks each value of `field` before it returns it.
/// @throw InvalidInput "sweep.size"  thrown by the returned field if a value is not a positive length; names
///         the option.
SizeField checked_size(const SizeField& field, const std::string& option);

} // namespace lacuna::surface
