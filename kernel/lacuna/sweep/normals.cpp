// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/normals.h>

#include <lacuna/sweep/detail/harmonic_spread.h>
#include <lacuna/sweep/detail/rim.h>
#include <lacuna/sweep/detail/surface_smoothing.h>

namespace lacuna::sweep {

namespace {

/// Number of smoothing passes over each layer. More passes make quads more even but flatten the layer. Not
/// measured.
constexpr int kPasses = 5;

/// Move every node that is not on the rim to the mean of its neighbours.
void smooth(std::vector<Vec3>& layer, const NodeGraph& graph, const std::vector<char>& on_rim)
{
    std::vector<Vec3> next = layer;
    for (int pass = 0; pass < kPasses; ++pass) {
        for (std::size_t i = 0; i < layer.size(); ++i) {
            if (on_rim[i] != 0 || graph.of(i).empty()) continue;
            Vec3 sum = Vec3::Zero();
            for (const Index n : graph.of(i)) sum += layer[index(n)];
            next[i] = sum / static_cast<double>(graph.of(i).size());
        }
        std::swap(layer, next);
    }
}

} // namespace

LayerNodes place_along_normals(const mesh::QuadMesh& source, std::span<const Vec3> target,
                               const RimColumns& columns, const RunContext& context)
{
    check_columns(source, columns, target);
    const std::size_t count = source.nodes.size();
    const NodeGraph graph = node_graph(source.quads, count);
    const HarmonicSpread spread(graph, side_weights(graph, source.quads, source.nodes), columns.rim, context);
    std::vector<char> on_rim(count, 0);
    for (const Index n : columns.rim) on_rim[index(n)] = 1;

    LayerNodes result;
    result.placement = Placement::normals;
    result.report = "layers: advanced along local normals and smoothed";
    std::vector<Vec3> layer = source.nodes;
    result.nodes = layer;
    for (int l = 1; l < columns.layers; ++l) {
        check_cancelled(context);
        // Spread the rim's steps along node normals over the inside. The first coordinate of the vectors
        // holds the length of the step.
        const std::vector<Vec3> normals = node_normals(source.quads, layer);
        const std::span<const Vec3> low = columns.row(l - 1), high = columns.row(l);
        std::vector<Vec3> steps(columns.rim.size()), step(count, Vec3::Zero());
        for (std::size_t k = 0; k < steps.size(); ++k) {
            const Vec3 normal = normals[index(columns.rim[k])].stableNormalized();
            steps[k] = Vec3((high[k] - low[k]).dot(normal), 0, 0);
        }
        spread.add(steps, 1, step.data(), count, context);
        for (std::size_t i = 0; i < count; ++i) layer[i] += step[i].x() * normals[i].stableNormalized();
        for (std::size_t k = 0; k < high.size(); ++k) layer[index(columns.rim[k])] = high[k];
        smooth(layer, graph, on_rim);
        result.nodes.insert(result.nodes.end(), layer.begin(), layer.end());
    }
    result.nodes.insert(result.nodes.end(), target.begin(), target.end());
    return result;
}

} // namespace lacuna::sweep
