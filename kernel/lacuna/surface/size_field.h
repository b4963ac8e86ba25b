// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/types.h>

#include <functional>

namespace lacuna::surface {

/// Target edge length at a position; positive and finite [model length].
using SizeField = std::function<double(const Vec3&)>;

/// Size fields on faces.
struct SizeFields {
    SizeField edge; ///< length of the quads' sides
    /// Height of the rows of quads along the loops; smoothing keeps these heights. Empty: no such rows.
    SizeField row{};
};

} // namespace lacuna::surface
