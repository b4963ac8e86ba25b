// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/face_plane.h>

#include <algorithm>
#include <cmath>

namespace lacuna::topology {

bool lies_in_plane(const Model& model, FaceId face, const geometry::Plane& plane)
{
    return std::ranges::all_of(model[face].triangles, [&](const Triangle& t) {
        return std::ranges::all_of(
            t, [&](Index p) { return std::abs(geometry::height(plane, model.at(p))) <= model.tolerance; });
    });
}

std::optional<geometry::Plane> plane_of(const Model& model, FaceId face)
{
    const Vec3 area = face_area_vector(model, face);
    if (!(area.norm() > 0)) return std::nullopt;
    const geometry::Plane plane = geometry::plane_across(face_centroid(model, face), area);
    return lies_in_plane(model, face, plane) ? std::optional(plane) : std::nullopt;
}

} // namespace lacuna::topology
