// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/view/detail/raster.h>

#include <string>

namespace lacuna::view {

/// A PNG with eight bits per channel (RFC 2083); each row is predicted from the row above.
std::string png_of(const Image& image);

} // namespace lacuna::view
