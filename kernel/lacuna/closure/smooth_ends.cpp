// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/smooth_ends.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/patches.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lacuna::closure {

using namespace topology;

namespace {

bool is_free_of_meshes(const Face& face) { return face.origin == Origin::given && face.given_quads.empty(); }

/// Depth of faces relative to their width: their extent along their mean normal, divided by the diameter of a
/// disc with their projected area.
double depth_by_width(const Model& model, const std::vector<FaceId>& faces)
{
    const Vec3 area = area_vector_of(model, faces);
    const Vec3 normal = area.normalized();
    double low = kInfinity, high = -low;
    for (const FaceId face : faces) {
        for (const Index p : corners_of(model[face])) {
            low = std::min(low, model.at(p).dot(normal));
            high = std::max(high, model.at(p).dot(normal));
        }
    }
    return (high - low) / std::sqrt(4 * area.norm() / std::numbers::pi);
}

/// The walls that meet an end smoothly, and those that meet such walls smoothly. Empty if the end must not be
/// extended, see extend_smooth_ends().
std::vector<FaceId> smooth_walls(const OpenVolume& volume, Role end, const std::vector<double>& angle)
{
    const Model& model = volume.model;
    const std::vector<FaceId> given = volume.faces(end);
    std::vector<FaceId> extended = given;
    for (std::size_t i = 0; i < extended.size(); ++i) {
        if (!is_free_of_meshes(model[extended[i]])) return {};
        for (const EdgeUse& use : uses_of(model[extended[i]])) {
            if (angle[use.edge.index()] >= kCreaseAngle) continue;
            for (const FaceUse& user : model.uses_of_edge(use.edge)) {
                if (std::ranges::find(extended, user.face) != extended.end()) continue;
                if (volume.role[user.face.index()] != Role::wall) return {};
                extended.push_back(user.face);
            }
        }
    }
    if (extended.size() == given.size()) return {};
    if (rims(model, extended).size() != rims(model, given).size() || depth_by_width(model, extended) > 1)
        return {};
    for (const EdgeId edge : rim_edges(model, extended)) {
        for (const FaceUse& user : model.uses_of_edge(edge)) {
            const bool own = std::ranges::find(extended, user.face) != extended.end();
            if (!own && volume.role[user.face.index()] != Role::wall) return {};
        }
    }
    return {extended.begin() + std::ssize(given), extended.end()};
}

} // namespace

std::vector<FaceId> extend_smooth_ends(OpenVolume& sealed, const RunContext& context)
{
    const std::vector<double> angle = angles_across(sealed.model, context);
    std::vector<FaceId> joined;
    for (const Role end : {Role::source, Role::target}) {
        for (const FaceId wall : smooth_walls(sealed, end, angle)) {
            sealed.role[wall.index()] = end;
            joined.push_back(wall);
        }
    }
    return joined;
}

} // namespace lacuna::closure
