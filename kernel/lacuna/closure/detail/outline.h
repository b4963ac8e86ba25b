// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/closure/shared/void_geometry.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/triangulate.h>

#include <numeric>
#include <vector>

namespace lacuna::closure {

/// Boundary points of a face in the plane in which the face is triangulated. Points of a seam are listed
/// twice.
struct Outline {
    std::vector<Index> model_point; ///< by boundary point: its index in the model; empty if the points are
                                    ///< not in the model
    std::vector<Vec2> flat;
    std::vector<std::vector<Index>> loops;

    /// Add a loop.
    /// @param points  indices of its points in the model; empty if they are not in the model
    void add_loop(const std::vector<Vec2>& places, const std::vector<Index>& points = {})
    {
        std::vector<Index>& loop = loops.emplace_back(places.size());
        std::iota(loop.begin(), loop.end(), static_cast<Index>(flat.size()));
        flat.insert(flat.end(), places.begin(), places.end());
        model_point.insert(model_point.end(), points.begin(), points.end());
    }
};

/// Coordinates of projected points along the axes of a plane.
inline std::vector<Vec2> flat_places(const geometry::Plane& plane, const std::vector<Vec3>& places)
{
    std::vector<Vec2> flat;
    for (const Vec3& p : places) flat.push_back(geometry::to_plane(plane, p));
    return flat;
}

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
