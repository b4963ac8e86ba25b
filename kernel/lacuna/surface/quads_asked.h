// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// Whether a size asks for more quads than `most` on the source. They are counted over facets that are halved
/// as long as the size changes on them; a face of four sides, which a grid may fill, has as many as the sides
/// of its rim make.
/// @note  O(min(quads asked for, most)) sizes.
bool asks_for_more(const topology::OpenVolume& volume, const SizeField& size, double most);

} // namespace lacuna::surface
