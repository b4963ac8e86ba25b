// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/rim.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/criteria.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace lacuna::sweep {

namespace {

constexpr const char* kColumns = "sweep.columns"; // error code

NamedEntity source_node(Index node) { return {"source node", node}; }

/// For each source node, the column over it; -1: none.
std::vector<Index> column_of_node(const mesh::QuadMesh& source, const RimColumns& columns)
{
    std::vector<Index> column(source.nodes.size(), -1);
    for (std::size_t k = 0; k < columns.rim.size(); ++k) {
        const Index node = columns.rim[k];
        if (node < 0 || index(node) >= source.nodes.size()) {
            throw InvalidInput(kColumns, "column {} stands on {}, but the source has nodes 0 to {} - 1", k,
                               source_node(node), source.nodes.size());
        }
        if (column[index(node)] >= 0) {
            throw InvalidInput(Message(kColumns, "two columns stand on {}", source_node(node))
                                   .remedy("give each rim node one column"));
        }
        column[index(node)] = static_cast<Index>(k);
    }
    return column;
}

/// Check that a row coincides with the rim nodes of a mesh, up to projection errors.
void check_row(const RimColumns& columns, int layer, std::span<const Vec3> nodes, const char* end)
{
    const std::span<const Vec3> row = columns.row(layer);
    double reach = 0;
    for (const Vec3& p : row) reach = std::max(reach, (p - row[0]).norm());
    for (std::size_t k = 0; k < row.size(); ++k) {
        const Vec3& node = nodes[index(columns.rim[k])];
        const double gap = (row[k] - node).norm();
        if (gap <= kFileAccuracy * reach) continue;
        throw InvalidInput(kColumns,
                           "the column over {} ends {:.6f} away from its node on the {}: columns must start "
                           "and end on the rims",
                           source_node(columns.rim[k]), found(gap), end);
    }
}

} // namespace

void check_columns(const mesh::QuadMesh& source, const RimColumns& columns, std::span<const Vec3> target)
{
    if (columns.layers < 1) {
        throw InvalidInput(kColumns, "a sweep needs at least {} layer, found {}", needed(1),
                           found(columns.layers));
    }
    const std::size_t expected = (static_cast<std::size_t>(columns.layers) + 1) * columns.rim.size();
    if (columns.points.size() != expected) {
        throw InvalidInput(kColumns, "columns of {} layers over {} rim nodes need {} points, found {}",
                           columns.layers, columns.rim.size(), needed(expected),
                           found(columns.points.size()));
    }
    for (std::size_t i = 0; i < columns.points.size(); ++i) {
        if (columns.points[i].allFinite()) continue;
        throw InvalidInput(kColumns,
                           "the column over {} has a coordinate that is not a finite number in layer {}",
                           source_node(columns.rim[i % columns.rim.size()]), i / columns.rim.size());
    }
    column_of_node(source, columns);
    if (columns.rim.empty()) return;
    check_row(columns, 0, source.nodes, "source");
    if (!target.empty()) check_row(columns, columns.layers, target, "target");
}

std::vector<Segment> rim_sides(const mesh::QuadMesh& source, const RimColumns& columns)
{
    const std::vector<Index> column = column_of_node(source, columns);
    std::vector<Segment> sides;
    const auto add = [&](Index from, Index to) {
        for (const Index node : {from, to}) {
            if (column[index(node)] >= 0) continue;
            throw InvalidInput(
                kColumns,
                "{} is on the boundary of the source mesh but has no column: every rim node needs one",
                source_node(node));
        }
        sides.push_back({column[index(from)], column[index(to)]});
    };
    if (source.loops.empty()) {
        for (const mesh::BoundarySide& side : mesh::boundary_sides(source.quads)) add(side.from, side.to);
    } else {
        for (const std::vector<Index>& loop : source.loops) {
            for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()]);
        }
    }
    return sides;
}

Vec3 rim_area(std::span<const Vec3> rim, std::span<const Segment> sides)
{
    const Vec3 centre = geometry::mean_point(rim);
    Vec3 twice = Vec3::Zero();
    for (const Segment& side : sides) {
        const Vec3 from = rim[index(side[0])] - centre;
        twice += from.cross(rim[index(side[1])] - centre);
    }
    return twice / 2;
}

double shortest_side(std::span<const Quad> quads, std::span<const Vec3> nodes)
{
    double shortest = kInfinity;
    for (const Quad& quad : quads) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (!mesh::is_side(quad, i)) continue;
            const Vec3& from = nodes[index(quad[i])];
            const Vec3& to = nodes[static_cast<std::size_t>(quad[(i + 1) % 4])];
            shortest = std::min(shortest, (to - from).squaredNorm());
        }
    }
    return quads.empty() ? 0 : std::sqrt(shortest);
}

double radius(std::span<const Vec3> points)
{
    const Vec3 centre = geometry::mean_point(points);
    double sum = 0;
    for (const Vec3& p : points) sum += (p - centre).squaredNorm();
    return points.empty() ? 0 : std::sqrt(sum / static_cast<double>(points.size()));
}

RimFitter::RimFitter(std::span<const Vec3> rim, std::span<const Segment> sides, std::span<const Vec3> nodes)
    : points_(rim), paired_(rim, rim_area(rim, sides))
{
    if (points_.rank() < 3) return;
    double rim_reach = 0;
    for (const Vec3& p : rim) rim_reach = std::max(rim_reach, points_.reach(p));
    // A map that is fitted to the rim alone is used only if no node is more than twice as far out as the
    // farthest point of the rim. Farther out, it would extrapolate too much.
    spans_inside_ = std::ranges::all_of(nodes,
                                        [&](const Vec3& p) { return points_.reach(p) <= 2 * rim_reach; });
}

geometry::AffineFit RimFitter::fit(std::span<const Vec3> to, const Vec3& to_area, double negligible) const
{
    if (spans_inside_) {
        const geometry::AffineFit alone = points_.fit(to);
        if (alone.max_residual <= negligible && alone.linear.determinant() > 0) return alone;
    }
    return paired_.fit(to, to_area);
}

} // namespace lacuna::sweep
