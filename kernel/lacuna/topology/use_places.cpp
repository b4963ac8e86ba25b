// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/use_places.h>

namespace lacuna::topology {

double length_of(const Model& model, const std::vector<EdgeUse>& uses)
{
    double sum = 0;
    for (const EdgeUse& use : uses) sum += edge_length(model, use.edge);
    return sum;
}

std::vector<Index> use_points(const Model& model, const std::vector<EdgeUse>& uses)
{
    std::vector<Index> result = loop_points(model, uses);
    result.push_back(model[use_to(model, uses.back())].point);
    return result;
}

std::vector<Index> loop_points(const Model& model, const std::vector<EdgeUse>& uses)
{
    std::vector<Index> result;
    for (const EdgeUse& use : uses) {
        const std::vector<Index> points = use_points(model, use);
        result.insert(result.end(), points.begin(), points.end() - 1);
    }
    return result;
}

std::vector<Vec3> places_at(const Model& model, const std::vector<Index>& points)
{
    std::vector<Vec3> result;
    result.reserve(points.size());
    for (const Index p : points) result.push_back(model.at(p));
    return result;
}

std::vector<Vec3> use_places(const Model& model, EdgeUse use)
{
    return places_at(model, use_points(model, use));
}

std::vector<Vec3> use_places(const Model& model, const std::vector<EdgeUse>& uses)
{
    return places_at(model, use_points(model, uses));
}

std::vector<Vec3> loop_places(const Model& model, const std::vector<EdgeUse>& uses)
{
    return places_at(model, loop_points(model, uses));
}

} // namespace lacuna::topology
