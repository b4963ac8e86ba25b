// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/quads/detail/outline_symmetry.h>
#include <lacuna/quads/pattern_counts.h>

namespace lacuna::quads {

/// Give the axes of a part numbers of sides with which one grid fills it, as `pattern_counts()` does; where
/// there are none, those of the size with an even number round the part.
void count_axes(MirrorPart& part, const std::function<double(const Vec2&)>& size);

} // namespace lacuna::quads
