// SPDX-License-Identifier: MIT
//
// Before the rim residual is spread, every inner layer is (1 - h) · A(source node) + h · B(target node). Here
// h is the relative height of the layer, and A and B are the affine maps that take the rim of the source and
// the rim of the target to the rim of the layer. If an affine motion relates the rims, both terms agree and
// the sum is that motion.
#include <lacuna/sweep/detail/layer_placer.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/background.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/large_pages.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/sweep/detail/rim.h>

#include <algorithm>
#include <array>
#include <atomic>

namespace lacuna::sweep {

namespace {

/// Relative height of each layer: the share of a column's length below the layer, averaged over the columns.
std::vector<double> mean_heights(const RimColumns& columns)
{
    const auto layers = index(columns.layers);
    std::vector<double> heights(layers + 1, 0.0);
    std::vector<double> length(layers + 1, 0.0);
    std::size_t counted = 0;
    for (std::size_t k = 0; k < columns.rim.size(); ++k) {
        for (std::size_t l = 1; l <= layers; ++l) {
            const std::size_t at = l * columns.rim.size() + k;
            length[l] = length[l - 1] + (columns.points[at] - columns.points[at - columns.rim.size()]).norm();
        }
        if (!(length[layers] > 0)) continue; // source and target share this node
        ++counted;
        for (std::size_t l = 1; l <= layers; ++l) heights[l] += length[l] / length[layers];
    }
    for (std::size_t l = 1; l <= layers; ++l) {
        heights[l] = counted > 0 ? heights[l] / static_cast<double>(counted)
                                 : static_cast<double>(l) / static_cast<double>(layers);
    }
    return heights;
}

void check_ends(const mesh::QuadMesh& source, std::span<const Vec3> target, const RimColumns& columns)
{
    if (target.size() != source.nodes.size()) {
        throw InvalidInput("sweep.target",
                           "the target needs a position for each of the {} source nodes, found {}",
                           needed(source.nodes.size()), found(target.size()));
    }
    check_columns(source, columns, target);
}

std::vector<double> heights_of(const RimColumns& columns, const PlacementOptions& options)
{
    if (options.heights.empty()) return mean_heights(columns);
    if (options.heights.size() != index(columns.layers) + 1) {
        throw InvalidInput("sweep.layer_heights",
                           "columns of {} layers need one height more than layers, found {}", columns.layers,
                           found(options.heights.size()));
    }
    return options.heights;
}

} // namespace

LayerPlacer::LayerPlacer(const mesh::QuadMesh& source, std::span<const Vec3> target,
                         const RimColumns& columns, const PlacementOptions& options,
                         const RunContext& context, std::span<Vec3> room)
    : source_(source), target_(target), columns_(columns)
{
    check_ends(source, target, columns);
    const std::vector<double> heights = heights_of(columns, options);
    if (options.straight_lines || columns.rim.empty()) {
        placement_ = Placement::straight;
        fit_straight(heights);
    } else {
        fit_rims(heights, context, room);
    }
}

void LayerPlacer::fit_straight(std::span<const double> heights)
{
    for (int l = 1; l < columns_.layers; ++l) {
        const double height = heights[index(l)];
        maps_.push_back(
            {(1 - height) * Eigen::Matrix3d::Identity(), height * Eigen::Matrix3d::Identity(), Vec3::Zero()});
    }
}

void LayerPlacer::fit_rims(std::span<const double> heights, const RunContext& context, std::span<Vec3> room)
{
    const std::vector<Segment> sides = rim_sides(source_, columns_);
    const std::span<const Vec3> low = columns_.row(0);
    const std::span<const Vec3> high = columns_.row(columns_.layers);
    const RimFitter from_source(low, sides, source_.nodes);
    const RimFitter from_target(high, sides, target_);
    const double low_size = radius(low);
    const double side_by_radius = low_size > 0 ? shortest_side(source_.quads, source_.nodes) / low_size : 0;

    const auto inner = index(std::max(columns_.layers - 1, 0));
    maps_.resize(inner);
    residuals_.resize(inner * low.size());
    struct Fitted {
        double residual = 0, size = 0;
        bool exact = true;
    };
    std::vector<Fitted> fitted(inner);
    parallel_each(context, inner, 4, [&](std::size_t i) {
        const double height = heights[i + 1];
        const std::span<const Vec3> rim = columns_.row(static_cast<int>(i) + 1);
        const Vec3 area = rim_area(rim, sides);
        const double size = radius(rim);
        const double negligible = kVisible * side_by_radius * size;
        const geometry::AffineFit up = from_source.fit(rim, area, negligible);
        const geometry::AffineFit down = from_target.fit(rim, area, negligible);
        maps_[i] = {(1 - height) * up.linear, height * down.linear,
                    (1 - height) * (up.to_centre - up.linear * up.from_centre) +
                        height * (down.to_centre - down.linear * down.from_centre)};
        fitted[i].size = size;
        for (std::size_t k = 0; k < rim.size(); ++k) {
            Vec3& residual = residuals_[i * rim.size() + k];
            residual = rim[k] - (1 - height) * up(low[k]) - height * down(high[k]);
            const double length = residual.norm();
            fitted[i].exact = fitted[i].exact && length <= negligible;
            fitted[i].residual = std::max(fitted[i].residual, length);
        }
    });
    bool exact = true;
    for (const Fitted& layer : fitted) {
        exact = exact && layer.exact;
        if (layer.residual <= residual_) continue;
        residual_ = layer.residual;
        size_ = 2 * layer.size;
    }
    if (!exact) placement_ = Placement::fitted;
    if (exact) {
        residuals_.clear();
        return;
    }
    // The factorisation uses one thread; a second one, if available, clears memory pages meanwhile.
    std::atomic<bool> enough{false};
    const Background<bool> clearing(context, [&enough, room](const RunContext&) {
        clear_pages(room.data(), room.size_bytes(), enough);
        return true;
    });
    const NodeGraph graph = node_graph(source_.quads, source_.nodes.size());
    // Both ends contribute to the weights, so that the result does not depend on which end is the source.
    const std::array<std::span<const Vec3>, 2> ends{source_.nodes, target_};
    std::array<std::vector<double>, 2> weights;
    parallel_each(context, 2, 1,
                  [&](std::size_t e) { weights[e] = side_weights(graph, source_.quads, ends[e]); });
    for (std::size_t k = 0; k < weights[0].size(); ++k) weights[0][k] += weights[1][k];
    spread_.emplace(graph, weights[0], columns_.rim, context);
    enough = true;
}

void LayerPlacer::place(int first, int last, std::span<Vec3> out, const RunContext& context) const
{
    const std::size_t nodes = source_.nodes.size(), rim = columns_.rim.size();
    const auto at = [&](int l) { return out.data() + index(l - first) * nodes; };
    if (first == 0) std::copy(source_.nodes.begin(), source_.nodes.end(), at(0));
    if (last == columns_.layers + 1) std::copy(target_.begin(), target_.end(), at(columns_.layers));
    const int low_inner = std::max(first, 1), high_inner = std::min(last, columns_.layers);
    const int groups = std::max(0, (high_inner - low_inner + HarmonicSpread::kFields - 1) /
                                       HarmonicSpread::kFields);
    const auto each_group = [&](std::size_t begin, std::size_t end, const auto& visit) {
        for (auto group = static_cast<int>(begin); group < static_cast<int>(end); ++group) {
            const int low = low_inner + group * HarmonicSpread::kFields;
            const auto count = index(std::min(HarmonicSpread::kFields, high_inner - low));
            visit(at(low), index(low - 1), count);
        }
    };
    const auto map = [&](Vec3* layer, std::size_t i, std::size_t count, std::size_t begin, std::size_t end,
                         const HarmonicSpread::Fields* residuals) {
        map_nodes(std::span(maps_).subspan(i, count), source_.nodes.data(), target_.data(), begin, end,
                  residuals, layer, nodes);
    };
    if (spread_) {
        parallel_for(context, index(groups), 1, [&](std::size_t begin, std::size_t end) {
            each_group(begin, end, [&](Vec3* layer, std::size_t i, std::size_t count) {
                const HarmonicSpread::Fields residuals = spread_->spread(
                    std::span(residuals_).subspan(i * rim, count * rim));
                map(layer, i, count, 0, nodes, &residuals);
            });
        });
    } else {
        // The nodes of a task take 24 kB at both ends. They stay in the first-level cache until the nodes of
        // all layers are written.
        parallel_for(context, nodes, kPerTask, [&](std::size_t begin, std::size_t end) {
            each_group(0, index(groups), [&](Vec3* layer, std::size_t i, std::size_t count) {
                map(layer, i, count, begin, end, nullptr);
            });
        });
    }
    parallel_for(context, index(last - first), 1 + kBetweenPolls / std::max<std::size_t>(1, rim),
                 [&](std::size_t begin, std::size_t end) {
                     for (int l = first + static_cast<int>(begin); l < first + static_cast<int>(end); ++l) {
                         const std::span<const Vec3> row = columns_.row(l);
                         Vec3* layer = at(l);
                         for (std::size_t k = 0; k < rim; ++k) layer[columns_.rim[k]] = row[k];
                     }
                 });
}

std::string LayerPlacer::report() const
{
    if (placement_ == Placement::straight) return "layers: straight lines between source and target";
    const double residual = size_ > 0 ? residual_ / size_ : 0;
    if (placement_ == Placement::affine)
        return formatted("layers: affine motion of the rims, exact to {:.2g} of their size", residual);
    return formatted(
        "layers: affine fit from both ends, rim residual of {:.2g} of its size spread harmonically",
        residual);
}

LayerNodes place_layers(const mesh::QuadMesh& source, std::span<const Vec3> target, const RimColumns& columns,
                        const PlacementOptions& options, const RunContext& context)
{
    check_ends(source, target, columns);
    LayerNodes result;
    const std::size_t count = (index(columns.layers) + 1) * source.nodes.size();
    reserve_large(result.nodes, count);
    result.nodes.resize(count);
    const LayerPlacer placer(source, target, columns, options, context, result.nodes);
    result.placement = placer.placement();
    result.report = placer.report();
    placer.place(0, columns.layers + 1, result.nodes, context);
    return result;
}

} // namespace lacuna::sweep
