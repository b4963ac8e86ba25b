// SPDX-License-Identifier: MIT
#include <lacuna/surface/shared/wall_columns.h>

#include <lacuna/core/shared/limits.h>
#include <lacuna/surface/detail/edge_turning.h>
#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/topology/model.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Walls count as straight if their length differs by less than this share from that of straight lines
/// between the rims. With ten layers, this is half the height of a layer.
constexpr double kHardlyLonger = 0.05;

/// Whether the walls are straight: their area is close to (mean length of the rims) · (mean length of
/// straight columns). Walls that bend or bulge have more area, and walls with a waist have less.
/// @param straight  total length of the straight columns.
bool are_straight(const Model& model, const LinkingSurface& link, double straight, std::size_t columns)
{
    double area = 0;
    for (const FaceId wall : link.walls) area += face_area(model, wall);
    const double length = 2 * area / (link.source.length() + link.target.length());
    return std::abs(length * static_cast<double>(columns) - straight) < kHardlyLonger * straight;
}

std::vector<Vec3> straight_column(const LinkingSurface& link, const RimSegment& segment, int steps)
{
    const std::array low{segment.source_from}, high{link.target.wrapped(segment.target_from)};
    const Vec3 from = link.source.points(low).front(), to = link.target.points(high).front();
    std::vector<Vec3> points;
    for (int i = 0; i <= steps; ++i) points.emplace_back(from + static_cast<double>(i) / steps * (to - from));
    return points;
}

/// A point of a column on the walls. `s` is the start of the column as a share of the source rim's length.
/// `share` is the height of the point as a share of the walls' length.
struct ColumnPlace {
    double s, share;
};

/// The points of columns, on the walls.
std::vector<Vec3> mapped_points(const Model& model, const LinkingMap& map,
                                const std::vector<ColumnPlace>& places)
{
    std::vector<WallPosition> on_walls;
    std::size_t near = kNoIndex;
    for (const ColumnPlace& place : places)
        on_walls.push_back(map.locate(place.s, map.from_even(place.share), near));
    return points_at(model, on_walls);
}

} // namespace

std::vector<double> shares_on_line(const OpenVolume& volume, const LinkingSurface& link, std::size_t line,
                                   std::vector<double> heights, const RunContext& context)
{
    if (!has_bent_line(volume.model, link)) return heights;
    const std::shared_ptr<const LinkingMap> map = map_of(volume, link, true, context);
    for (double& height : heights) height = map->share_of_line(line, map->from_even(height));
    return heights;
}

std::vector<std::vector<Vec3>> wall_columns(const OpenVolume& volume, const LinkingSurface& link, int steps,
                                            const RunContext& context)
{
    std::vector<std::vector<Vec3>> columns;
    for (std::size_t l = 0; l < link.lines.size(); ++l) {
        const Chain chain(volume.model, link.lines[l].line.uses);
        std::vector<double> at;
        for (int i = 0; i <= steps; ++i) at.push_back(static_cast<double>(i) / steps);
        at = shares_on_line(volume, link, l, std::move(at), context);
        for (double& share : at) share *= chain.length();
        columns.push_back(chain.points(at));
    }
    if (!link.lines.empty()) return columns;
    double straight = 0;
    for (const RimSegment& segment : link.segments) {
        columns.push_back(straight_column(link, segment, steps));
        straight += (columns.back().back() - columns.back().front()).norm();
    }
    if (are_straight(volume.model, link, straight, columns.size())) return columns;
    const std::shared_ptr<const LinkingMap> map = map_of(volume, link, true, context);
    columns.clear();
    for (int k = 0; k < kChords; ++k) {
        std::vector<ColumnPlace> places;
        for (int i = 0; i <= steps; ++i)
            places.push_back({(k + 0.5) / kChords, static_cast<double>(i) / steps});
        columns.push_back(mapped_points(volume.model, *map, places));
    }
    return columns;
}

std::vector<std::vector<Vec3>> wall_rows(const OpenVolume& volume, const LinkingSurface& link,
                                         const LinkingNodes& nodes, int steps, const RunContext& context)
{

    std::vector<std::vector<Vec3>> rows{link.source.points(nodes.source_at)};
    if (steps > 1) {
        std::vector<ColumnPlace> places;
        for (int k = 1; k < steps; ++k)
            for (const double at : nodes.source_at)
                places.push_back({at / link.source.length(), static_cast<double>(k) / steps});
        check_cancelled(context);
        const std::vector<Vec3> points = mapped_points(volume.model, *map_of(volume, link, true, context),
                                                       places);
        for (auto at = points.begin(); at != points.end(); at += std::ssize(nodes.source_at))
            rows.emplace_back(at, at + std::ssize(nodes.source_at));
    }
    rows.push_back(target_points(link, nodes));
    return rows;
}

std::vector<double> turning_of_segments(const Model& model, const LinkingSurface& link)
{
    const EdgeTurning source(model, link.source.uses()), target(model, link.target.uses());
    std::vector<double> turning;
    for (const RimSegment& segment : link.segments) {
        const double from = std::fmod(segment.target_from, target.length());
        const double to = from + segment.target_to - segment.target_from;
        const double past = std::max(to - target.length(), 0.0);
        const double own = segment.follows ? 0 : source.between(segment.source_from, segment.source_to);
        const double other = segment.target_follows
                                 ? 0
                                 : target.between(from, to - past) + target.between(0, past);
        turning.push_back(std::max(own, other));
    }
    return turning;
}

} // namespace lacuna::surface
