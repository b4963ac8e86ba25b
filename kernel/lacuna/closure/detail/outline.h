// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/geometry/shared/triangulate.h>

#include <vector>

namespace lacuna::closure {

/// Boundary points of a face in its triangulation plane; the points of a seam are listed twice.
struct Outline {
    std::vector<Index> model_point;
    std::vector<Vec2> flat;
    std::vector<std::vector<Index>> loops;
};

/// Convert the triangulation of an outline to a filling; `lift` returns the position of an added point.
template <class Lift>
VoidFilling filling_of(const topology::Model& model, const Outline& outline,
                       const geometry::Triangulation& flat, const Lift& lift)
{
    VoidFilling result;
    const auto base = static_cast<Index>(model.points.size());
    const std::size_t rim = outline.flat.size();
    for (std::size_t i = rim; i < flat.points.size(); ++i) result.points.push_back(lift(i));
    for (const Triangle& t : flat.triangles) {
        Triangle mapped{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto p = static_cast<std::size_t>(t[i]);
            mapped[i] = p < rim ? outline.model_point[p] : base + static_cast<Index>(p - rim);
        }
        result.triangles.push_back(mapped);
    }
    return result;
}

} // namespace lacuna::closure
