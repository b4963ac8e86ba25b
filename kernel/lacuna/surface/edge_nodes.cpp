// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/edge_nodes.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>

#include <algorithm>

namespace lacuna::surface {

using namespace topology;

std::vector<Vec3> edge_line(const Model& model, EdgeId edge)
{
    std::vector<Vec3> line;
    line.reserve(model[edge].points.size());
    for (const Index p : model[edge].points) line.push_back(model.at(p));
    return line;
}

std::vector<Vec3> edge_points(const Model& model, EdgeId id, std::span<const double> fractions)
{
    const Edge& edge = model[id];
    const std::vector<Vec3> line = edge_line(model, id);
    const std::vector<double> arc = geometry::arc_lengths(line);

    std::vector<Vec3> result(fractions.size());
    std::vector<double> params;
    std::vector<std::size_t> inside;
    for (std::size_t i = 0; i < fractions.size(); ++i) {
        // At an end, the curve differs from the vertex by rounding. Use the vertex, so that all edges that
        // meet there have the same point.
        if (fractions[i] < kSamePlace) {
            result[i] = line.front();
        } else if (fractions[i] > 1 - kSamePlace) {
            result[i] = line.back();
        } else {
            const geometry::PolylinePlace at = geometry::place_at(arc, fractions[i] * arc.back());
            // Points of the polyline are returned bit for bit, so that given nodes do not move.
            if (edge.curve == nullptr && std::min(at.fraction, 1 - at.fraction) < kSamePlace) {
                result[i] = line[at.segment + (at.fraction < 0.5 ? 0 : 1)];
            } else if (edge.curve == nullptr) {
                result[i] = (1 - at.fraction) * line[at.segment] + at.fraction * line[at.segment + 1];
            } else {
                params.push_back((1 - at.fraction) * edge.params[at.segment] +
                                 at.fraction * edge.params[at.segment + 1]);
                inside.push_back(i);
            }
        }
    }
    if (!inside.empty()) {
        std::vector<Vec3> exact(inside.size());
        edge.curve->evaluate(params, exact);
        for (std::size_t k = 0; k < inside.size(); ++k) result[inside[k]] = exact[k];
    }
    return result;
}

Chain::Chain(const Model& model, std::vector<EdgeUse> uses)
    : model_(&model), uses_(std::move(uses)), start_{0}
{
    for (const EdgeUse& use : uses_) start_.push_back(start_.back() + edge_length(model, use.edge));
}

ChainPosition Chain::position(double s) const
{
    const auto after = std::upper_bound(start_.begin(), start_.end(), s);
    const auto found = static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - start_.begin() - 1, 0));
    const std::size_t use = std::min(found, uses_.size() - 1);
    const double along = std::clamp((s - start_[use]) / (start_[use + 1] - start_[use]), 0.0, 1.0);
    return {use, uses_[use].reversed ? 1 - along : along};
}

std::vector<Vec3> Chain::points(std::span<const double> lengths) const
{
    std::vector<Vec3> result(lengths.size());
    std::vector<ChainPosition> positions;
    positions.reserve(lengths.size());
    for (const double s : lengths) positions.push_back(position(s));
    for (std::size_t i = 0; i < positions.size();) {
        std::vector<double> fractions;
        std::size_t j = i;
        while (j < positions.size() && positions[j].use == positions[i].use)
            fractions.push_back(positions[j++].fraction);
        const std::vector<Vec3> on_edge = edge_points(*model_, uses_[positions[i].use].edge, fractions);
        std::copy(on_edge.begin(), on_edge.end(), result.begin() + static_cast<std::ptrdiff_t>(i));
        i = j;
    }
    return result;
}

} // namespace lacuna::surface
