// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/swept_motion.h>

#include <lacuna/geometry/shared/swept_surface.h>
#include <lacuna/topology/shared/face_parts.h>

#include <optional>
#include <vector>

namespace lacuna::surface {

using namespace topology;

geometry::MotionPointer swept_motion(const OpenVolume& volume)
{
    const Model& model = volume.model;
    const std::vector<FaceId> walls = volume.faces(Role::wall);
    const auto surface_of = [&](FaceId wall) {
        return dynamic_cast<const geometry::SweptSurface*>(model[wall].surface.get());
    };
    if (walls.empty() || surface_of(walls.front()) == nullptr) return nullptr; // usual case
    std::vector<std::optional<Role>> end(model.points.size());
    for (std::size_t f = 0; f < model.faces.size(); ++f)
        if (volume.role[f] != Role::wall)
            for (const Index p : corners_of(model.faces[f])) end[index(p)] = volume.role[f];
    geometry::MotionPointer motion;
    std::optional<double> first; // height of the source on the swept surfaces: 0 or 1
    for (const FaceId wall : walls) {
        const Face& face = model[wall];
        const auto* swept = surface_of(wall);
        if (swept == nullptr || (motion && motion != swept->motion())) return nullptr;
        motion = swept->motion();
        for (std::size_t t = 0; t < face.triangles.size(); ++t) {
            for (std::size_t i = 0; i < 3; ++i) {
                const std::optional<Role> role = end[index(face.triangles[t][i])];
                if (!role) continue;
                const double height = face.uv[t][i].y();
                const double source = *role == Role::source ? height : 1 - height;
                if ((source != 0 && source != 1) || source != first.value_or(source)) return nullptr;
                first = source;
            }
        }
    }
    if (!first || *first == 0) return motion;
    return geometry::part_of_motion(motion, 1, 0);
}

} // namespace lacuna::surface
