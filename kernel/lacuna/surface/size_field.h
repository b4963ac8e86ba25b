// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <functional>

namespace lacuna::surface {

/// Target edge length at a place; positive and finite [model length].
using SizeField = std::function<double(const Vec3&)>;

/// Lengths asked for on faces.
struct SizeFields {
    SizeField edge;  ///< of the quads' sides
    SizeField row{}; ///< height of rows along the loops that smoothing keeps; empty: none are asked for
};

} // namespace lacuna::surface
