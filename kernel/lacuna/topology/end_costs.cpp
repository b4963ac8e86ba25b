// SPDX-License-Identifier: MIT
#include <lacuna/topology/detail/end_costs.h>

#include <lacuna/topology/auto_roles.h>
#include <lacuna/topology/detail/directed_sides.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lacuna::topology {

namespace {

/// Cost of two free loops as the rims of missing ends. Empty if they cannot be such rims: one loop lies
/// inside the other in the same plane, or an end on a loop would only continue a face next to the loop.
std::optional<double> cap_cost(const Model& model, const Rim& first, const Rim& second)
{
    double cost = 0;
    std::vector<Vec3> centre;
    std::vector<double> size;
    for (const Rim* rim : {&first, &second}) {
        const std::vector<Vec3> points = loop_places(model, rim->uses);
        const double length = length_of(model, rim->uses);
        Vec3 mean = Vec3::Zero(), area = Vec3::Zero();
        for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            area += (points[i] - mean).cross(points[(i + 1) % points.size()] - mean) / 2;
        double bulge = 0;
        for (const Vec3& p : points)
            bulge = std::max(bulge, std::abs((p - mean).dot(area.stableNormalized())));
        cost += bulge / length;
        centre.push_back(mean);
        size.push_back(length);
        double along = 0;
        for (const EdgeUse& use : rim->uses) {
            const FaceId wall = model.uses_of_edge(use.edge).front().face;
            const Vec3 normal = face_area_vector(model, wall).stableNormalized();
            const double flat = face_area_vector(model, wall).norm() / face_area(model, wall);
            along += edge_length(model, use.edge) * flat * std::abs(normal.dot(area.stableNormalized()));
        }
        if (along > 0.9 * length) return std::nullopt;
    }
    if ((centre[0] - centre[1]).norm() < 1e-3 * std::max(size[0], size[1])) return std::nullopt;
    return cost;
}

} // namespace

double bend(const SmoothPatch& end)
{
    // A patch that bends by 90° (flatness 0.90) costs 0.4, and one that bends by 180° costs 1: the unit
    // of all costs.
    return std::min(1.0, 4 * (1 - end.flatness));
}

double cost_of_two_ends(const SmoothPatch& s, const SmoothPatch& t)
{
    // The ends of a sweep face each other: the line between their centres is along both normals.
    const Vec3 way = (t.centre - s.centre).stableNormalized();
    const double facing =
        1 - (std::abs(way.dot(s.normal)) * s.flatness + std::abs(way.dot(t.normal)) * t.flatness) / 2;
    const double unlike = std::abs(std::log(s.area / t.area)) / 4;
    return bend(s) + bend(t) + (s.slant + t.slant) / 2 + facing / 2 + unlike;
}

std::optional<double> cost_of_no_end(const Model& model)
{
    double cost = 0;
    const auto parts = connected_parts(model, all_faces(model));
    if (parts.empty()) return std::nullopt;
    DirectedSides sides(model.points.size());
    for (const std::vector<FaceId>& part : parts) {
        const std::vector<Rim> open = rims(model, part);
        if (open.size() != 2 || euler_number(model, part, sides) != 0) return std::nullopt;
        const auto cap = cap_cost(model, open[0], open[1]);
        if (!cap) return std::nullopt;
        cost += *cap;
    }
    return kNoEnd + cost / static_cast<double>(parts.size());
}

} // namespace lacuna::topology
