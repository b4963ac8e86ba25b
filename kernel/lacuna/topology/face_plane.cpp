// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/face_plane.h>

#include <lacuna/topology/shared/face_parts.h>

#include <algorithm>
#include <cmath>

namespace lacuna::topology {

bool lies_in_plane(const Model& model, FaceId face, const geometry::Plane& plane)
{
    return std::ranges::all_of(corners_of(model[face]), [&](Index p) {
        return std::abs(geometry::height(plane, model.at(p))) <= model.tolerance;
    });
}

geometry::Plane mean_plane(const Model& model, FaceId face)
{
    return geometry::plane_across(face_centroid(model, face), face_area_vector(model, face));
}

std::optional<geometry::Plane> plane_of(const Model& model, FaceId face)
{
    if (!(face_area_vector(model, face).norm() > 0)) return std::nullopt;
    const geometry::Plane plane = mean_plane(model, face);
    return lies_in_plane(model, face, plane) ? std::optional(plane) : std::nullopt;
}

} // namespace lacuna::topology
