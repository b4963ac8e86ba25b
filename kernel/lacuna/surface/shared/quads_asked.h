// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/surface/size_field.h>
#include <lacuna/topology/open_volume.h>

namespace lacuna::surface {

/// Whether a size field requests more quads than `most` on the source. Quads are counted over facets, which
/// are subdivided while the size varies on them. On a four-sided face, which may be mapped, the count follows
/// from the numbers of sides of its rim.
/// @note  O(min(quads asked for, most)) sizes.
bool asks_for_more(const topology::OpenVolume& volume, const SizeField& size, double most);

} // namespace lacuna::surface
