// SPDX-License-Identifier: MIT
#include <lacuna/matching/detail/loop_shape.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/matching/shared/corners.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lacuna::matching {

using namespace topology;

std::vector<Vec3> even_samples(const LoopShape& shape, double start, bool backward)
{
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < kFineChords; ++i) {
        const double s = start + (backward ? -1 : 1) * shape.length * static_cast<double>(i) / kFineChords;
        result.push_back(
            geometry::point_at(shape.points, shape.arc, s - shape.length * std::floor(s / shape.length)));
    }
    return result;
}

std::vector<Vec3> edge_samples(const LoopShape& shape, std::size_t start, bool backward)
{
    std::vector<Vec3> result;
    const std::size_t n = shape.vertices.size();
    const auto at = [&](double s) { result.push_back(geometry::point_at(shape.points, shape.arc, s)); };
    const std::size_t each = std::max<std::size_t>(1, kFineChords / n);
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t edge = backward ? (start + 2 * n - k - 1) % n : (start + k) % n;
        const double from = shape.vertex_arc[edge];
        const double to = edge + 1 < n ? shape.vertex_arc[edge + 1] : shape.length;
        for (std::size_t i = 0; i < each; ++i) {
            const double f = static_cast<double>(i) / static_cast<double>(each);
            at(backward ? to + (from - to) * f : from + (to - from) * f);
        }
    }
    return result;
}

LoopShape shape_of(const Model& model, const Rim& rim, const std::set<EdgeId>& kept)
{
    LoopShape shape;
    for (const EdgeUse& use : rim.uses) shape.vertices.push_back(use_from(model, use));
    std::vector<std::size_t> first;
    for (const EdgeUse& use : rim.uses) {
        const std::vector<Index> chain = use_points(model, use);
        first.push_back(shape.points.size());
        shape.sides.push_back(kept.contains(use.edge) ? chain.size() - 1 : 0);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) shape.points.push_back(model.at(chain[i]));
    }
    shape.area = geometry::newell_vector(shape.points);
    shape.centroid = geometry::centre_of_ring(shape.points);
    shape.points.push_back(shape.points.front());
    shape.arc = geometry::arc_lengths(shape.points);
    shape.length = shape.arc.back();
    for (std::size_t u = 0; u < first.size(); ++u) {
        shape.vertex_arc.push_back(shape.arc[first[u]]);
        shape.corner.push_back(is_corner(model, rim.uses, u));
    }
    return shape;
}

std::size_t given_sides(const LoopShape& shape)
{
    if (std::ranges::find(shape.sides, std::size_t{0}) != shape.sides.end()) return 0;
    return std::accumulate(shape.sides.begin(), shape.sides.end(), std::size_t{0});
}

std::vector<std::size_t> first_sides(const LoopShape& shape)
{
    std::vector<std::size_t> first(shape.sides.size());
    std::exclusive_scan(shape.sides.begin(), shape.sides.end(), first.begin(), std::size_t{0});
    return first;
}

void count_by_sides(LoopShape& shape)
{
    const double side = shape.length / static_cast<double>(given_sides(shape));
    for (std::size_t i = 0; i < shape.arc.size(); ++i) shape.arc[i] = side * static_cast<double>(i);
    std::ranges::transform(first_sides(shape), shape.vertex_arc.begin(),
                           [&](std::size_t first) { return side * static_cast<double>(first); });
    shape.arc.back() = shape.length;
    shape.by_sides = true;
}

} // namespace lacuna::matching
