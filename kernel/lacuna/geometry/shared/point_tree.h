// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/geometry/shared/facet_tree.h>

namespace lacuna::geometry {

/// A tree of points: each point is a triangle without extent, and has its index as the triangle's index.
inline FacetTree point_tree(std::span<const Vec3> points)
{
    std::vector<Triangle> dots;
    for (Index p = 0; p < std::ssize(points); ++p) dots.push_back({p, p, p});
    return {points, dots};
}

} // namespace lacuna::geometry
