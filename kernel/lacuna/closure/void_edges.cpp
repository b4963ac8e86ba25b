// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/void_edges.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Segments of a void edge at most: a bend by 90° turns by less than 1.5° at each.
constexpr int kMostSegments = 64;

/// Facet points on the edges at a vertex: their mean spacing is length / segments.
struct Spacing {
    double length = 0;
    std::size_t segments = 0;

    void add(double more_length, std::size_t more_segments)
    {
        length += more_length;
        segments += more_segments;
    }
    [[nodiscard]] double mean() const { return segments > 0 ? length / static_cast<double>(segments) : 0; }
};

/// Count an edge at its ends.
void add_edge(const Model& model, EdgeId id, std::vector<Spacing>& at)
{
    const Edge& edge = model[id];
    const double length = edge_length(model, id);
    at[edge.from.index()].add(length, edge.points.size() - 1);
    if (edge.to != edge.from) at[edge.to.index()].add(length, edge.points.size() - 1);
}

/// Of every vertex.
std::vector<Spacing> spacing_of(const Model& model)
{
    std::vector<Spacing> at(model.vertices.size());
    for (std::size_t e = 0; e < model.edges.size(); ++e) add_edge(model, EdgeId(e), at);
    return at;
}

} // namespace

std::vector<EdgeId> make_void_edges(OpenVolume& volume, const matching::Match& match,
                                    const Follower* follower)
{
    Model& model = volume.model;
    const std::vector<bool> on_wall = volume.on_wall();
    std::vector<Spacing> spacing_at = spacing_of(model);
    std::vector<EdgeId> made;
    for (const auto& [source, target] : match.vertices) {
        if (on_wall[source.index()] || on_wall[target.index()]) continue;
        const Vec3 from = model.at(model[source].point);
        const Vec3 to = model.at(model[target].point);
        const double spacing = spacing_at[source.index()].mean();
        const double wanted = spacing > 0 ? (to - from).norm() / spacing : 1;
        int segments = static_cast<int>(
            std::clamp(std::round(wanted), 1.0, static_cast<double>(kMostSegments)));
        if (follower != nullptr) segments = kMostSegments;

        Edge edge;
        edge.origin = Origin::made_void;
        edge.tag = static_cast<int>(made.size()) + 1;
        edge.from = source;
        edge.to = target;
        edge.points.push_back(model[source].point);
        for (int i = 1; i < segments; ++i) {
            const double f = static_cast<double>(i) / segments;
            const Vec3 place = follower != nullptr ? follower->morph(from, to, f)
                                                   : Vec3((1 - f) * from + f * to);
            edge.points.push_back(static_cast<Index>(model.points.size()));
            model.points.push_back(place);
        }
        edge.points.push_back(model[target].point);
        made.emplace_back(model.edges.size());
        model.edges.push_back(std::move(edge));
        add_edge(model, made.back(), spacing_at);
    }
    return made;
}

} // namespace lacuna::closure
