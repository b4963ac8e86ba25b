// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/facet_tree.h>

namespace lacuna::geometry {

/// A tree whose triangles are single points, in the given order.
inline FacetTree point_tree(std::span<const Vec3> points)
{
    std::vector<Triangle> dots;
    for (Index p = 0; p < std::ssize(points); ++p) dots.push_back({p, p, p});
    return {points, dots};
}

} // namespace lacuna::geometry
