// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// Whether a size field requests more quads than `most` on the source. The quads on a face are counted over
/// its facets; a facet is subdivided until the size is nearly uniform on each part. A four-sided face may be
/// mapped; its quads are counted from the numbers of sides on its rim.
/// @note  O(min(quads asked for, most)) sizes.
bool asks_for_more(const topology::OpenVolume& volume, const SizeField& size, double most);

} // namespace lacuna::surface
