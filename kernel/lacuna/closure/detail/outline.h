// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/void_geometry.h>
#include <lacuna/geometry/triangulate.h>

#include <vector>

namespace lacuna::closure {

/// Boundary points of the face in the plane it is triangulated in; a seam's points stand twice.
struct Outline {
    std::vector<Index> model_point;
    std::vector<Vec2> flat;
    std::vector<std::vector<Index>> loops;
};

/// Turn a triangulation of an outline into a filling; `lift` gives the place of an added point.
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
