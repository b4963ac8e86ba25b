// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/row_columns.h>

#include <lacuna/core/error.h>
#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/core/shared/edge_key.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/geometry/shared/polyline.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>

namespace lacuna::sweep {

using namespace topology;

namespace {

/// Source nodes of the rows over both ends of a side of the rim, in order from the rim.
struct RowSide {
    int table = -1;
    std::vector<Index> before, after;
};

/// The sides of the source's quads, numbered 4 · quad + side.
struct SourceSides {
    const std::vector<Quad>& quads;
    std::vector<Index> partner;                       ///< adjacent side of the neighbouring quad
    std::unordered_map<std::uint64_t, Index> between; ///< side between two nodes

    explicit SourceSides(const mesh::QuadMesh& source)
        : quads(source.quads), partner(mesh::opposite_sides(quads, static_cast<Index>(source.nodes.size())))
    {
        for (std::size_t q = 0; q < quads.size(); ++q) {
            for (std::size_t k = 0; k < 4; ++k) {
                if (mesh::is_side(quads[q], k))
                    between.try_emplace(edge_key(quads[q][k], quads[q][(k + 1) % 4]),
                                        static_cast<Index>(4 * q + k));
            }
        }
    }
};

RowSide rows_over(const SweptParts& parts, const surface::LayerTables& tables, const SourceSides& sides,
                  std::size_t b, std::size_t i)
{
    RowSide row;
    row.table = tables.at(parts.wall_at(b, 0, i));
    if (row.table < 0) row.table = tables.at(parts.wall_at(b, index(parts.layers) - 1, i));
    if (row.table < 0) return row;
    const std::size_t rows = tables.heights[index(row.table)].size();
    auto from = static_cast<Index>(parts.rim_node(b, i));
    Index side = sides.between.at(edge_key(from, static_cast<Index>(parts.rim_node(b, i + 1))));
    for (std::size_t r = 0; r < rows; ++r) {
        const Quad quad = side < 0 ? Quad{} : sides.quads[index(side) / 4];
        if (side < 0 || mesh::is_triangle(quad)) {
            throw NotSweepable(
                Message("sweep.layers_rows",
                        "the quads of the source form {} rows along {}, but its boundary layers have {}",
                        found(r), entity_of(parts.volume.model, parts.wall_at(b, 0, i)), needed(rows))
                    .remedy("use quads = \"paved\" to remesh it"));
        }
        const std::size_t k = index(side) % 4;
        const bool along = quad[k] == from;
        row.before.push_back(quad[(k + (along ? 3 : 2)) % 4]);
        row.after.push_back(quad[(k + (along ? 2 : 3)) % 4]);
        from = row.before.back();
        side = sides.partner[index(side) / 4 * 4 + (k + 2) % 4];
    }
    return row;
}

/// Add the columns of a rim node. If the rows over both its sides have the same nodes above it, there is one
/// column; otherwise there is one for each side.
void add_columns(std::size_t b, std::size_t i, const RowSide& before, const RowSide& after,
                 std::vector<RowColumn>& columns)
{
    const bool one = before.table >= 0 && before.table == after.table && before.after == after.before;
    if (before.table >= 0) columns.push_back({b, i, true, one, before.table, before.after, {}});
    if (after.table >= 0 && !one) columns.push_back({b, i, false, true, after.table, after.before, {}});
}

} // namespace

std::vector<RowColumn> row_columns(const SweptParts& parts, const surface::LayerTables& tables)
{
    const SourceSides source_sides(parts.source.quads);
    std::vector<RowColumn> columns;
    for (std::size_t b = 0; b < parts.links.size(); ++b) {
        const std::size_t n = parts.size_of(b);
        std::vector<RowSide> sides;
        for (std::size_t i = 0; i < n; ++i) sides.push_back(rows_over(parts, tables, source_sides, b, i));
        for (std::size_t i = 0; i < n; ++i) add_columns(b, i, sides[(i + n - 1) % n], sides[i], columns);
    }
    const auto at = [&](std::size_t node) -> const Vec3& { return parts.source.quads.nodes[node]; };
    for (RowColumn& column : columns) {
        const Vec3 &foot = at(parts.rim_node(column.link, column.node)), along = column.tangent(parts, at);
        for (const Index node : column.nodes) column.lean.push_back((at(index(node)) - foot).dot(along));
    }
    return columns;
}

std::optional<double> place_at(const std::vector<Vec3>& line, const Vec3& normal, double height)
{
    double below = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
        const double above = (line[i] - line.front()).dot(normal);
        if (above >= height && above > below)
            return static_cast<double>(i) - 1 + (height - below) / (above - below);
        below = above;
    }
    return std::nullopt;
}

std::optional<LinePlaces> places_at(const std::vector<Vec3>& line, const std::array<HeightsOver, 2>& ends,
                                    const std::set<std::size_t>& still)
{
    const std::size_t sides = line.size() - 1;
    LinePlaces place{{0, 0.0}, {sides, static_cast<double>(sides)}};
    for (const std::size_t node : still) place[node] = static_cast<double>(node);
    for (const std::size_t end : {0, 1}) {
        if (ends[end].heights == nullptr) continue;
        std::vector<Vec3> walk = line;
        if (end == 1) std::ranges::reverse(walk);
        const std::vector<double>& heights = *ends[end].heights;
        for (std::size_t j = 0; j < heights.size() && j + 1 < sides; ++j) {
            const std::optional<double> at = place_at(walk, ends[end].normal, heights[j]);
            if (!at) return std::nullopt;
            const std::size_t node = end == 0 ? j + 1 : sides - 1 - j;
            if (!still.contains(node)) place[node] = end == 0 ? *at : static_cast<double>(sides) - *at;
        }
    }
    for (auto p = place.begin(); std::next(p) != place.end(); ++p)
        if (!(p->second < std::next(p)->second)) return std::nullopt;
    return place;
}

Vec3 point_at(const std::vector<Vec3>& line, double place)
{
    const auto side = std::min(static_cast<std::size_t>(place), line.size() - 2);
    const double share = place - static_cast<double>(side);
    return (1 - share) * line[side] + share * line[side + 1];
}

bool is_vertex(const surface::Chain& chain, double at)
{
    const double slack = kSamePlace * chain.length();
    const double nearest = chain.wrapped(at);
    for (std::size_t u = 0; u <= chain.uses().size(); ++u)
        if (std::abs(chain.start(u) - nearest) <= slack) return true;
    return false;
}

Vec3 nearest_on(const Model& model, const surface::Chain& chain, const Vec3& p)
{
    double best = kInfinity, length = 0;
    for (std::size_t u = 0; u < chain.uses().size(); ++u) {
        const std::vector<Index> points = use_points(model, chain.uses()[u]);
        double arc = chain.start(u);
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            const Vec3 &a = model.at(points[i]), side = model.at(points[i + 1]) - a;
            const double squared = side.squaredNorm();
            const double share = squared > 0 ? std::clamp((p - a).dot(side) / squared, 0.0, 1.0) : 0;
            const double off = (a + share * side - p).squaredNorm();
            if (off < best) {
                best = off;
                length = arc + share * std::sqrt(squared);
            }
            arc += std::sqrt(squared);
        }
    }
    // The exact curve differs slightly from its polyline. Two steps were enough in all cases tried.
    const double step = kDifference * chain.length();
    Vec3 point = p;
    for (int i = 0; i < kMostSteps; ++i) {
        length = std::clamp(length, 0.0, chain.length() - step);
        const double lengths[] = {length, length + step};
        const std::vector<Vec3> on = chain.points(lengths);
        point = on[0];
        const Vec3 tangent = (on[1] - on[0]) / step;
        const double off = (p - on[0]).dot(tangent) / tangent.squaredNorm();
        if (!(std::abs(off) > model.tolerance)) break;
        length += off;
    }
    return point;
}

std::vector<std::pair<std::size_t, double>> places_along(const std::vector<Vec3>& line,
                                                         const LinePlaces& place)
{
    const std::size_t sides = line.size() - 1;
    const std::vector<double> lengths = geometry::arc_lengths(line);
    const auto length_at = [&](double x) {
        const auto i = std::min(static_cast<std::size_t>(x), sides - 1);
        return lengths[i] + (x - static_cast<double>(i)) * (lengths[i + 1] - lengths[i]);
    };
    std::vector<std::pair<std::size_t, double>> moved;
    for (std::size_t i = 1; i < sides; ++i) {
        const auto above = place.lower_bound(i);
        if (above->first == i) {
            moved.emplace_back(i, above->second);
            continue;
        }
        const auto below = std::prev(above);
        const double share = (lengths[i] - lengths[below->first]) /
                             (lengths[above->first] - lengths[below->first]);
        const double length = length_at(below->second) +
                              share * (length_at(above->second) - length_at(below->second));
        const auto up = std::ranges::upper_bound(lengths, length);
        const std::size_t side = std::min(static_cast<std::size_t>(up - lengths.begin()) - 1, sides - 1);
        moved.emplace_back(i, static_cast<double>(side) +
                                  (length - lengths[side]) / (lengths[side + 1] - lengths[side]));
    }
    return moved;
}

} // namespace lacuna::sweep
