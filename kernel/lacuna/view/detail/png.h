// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/view/detail/raster.h>

#include <string>

namespace lacuna::view {

/// The bytes of a PNG of eight bits a channel (RFC 2083), rows predicted from the one above.
std::string png_of(const Image& image);

} // namespace lacuna::view
