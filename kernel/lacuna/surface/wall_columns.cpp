// SPDX-License-Identifier: MIT
#include <lacuna/surface/wall_columns.h>

#include <lacuna/surface/detail/linking_map.h>
#include <lacuna/topology/model.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace lacuna::surface {

using namespace topology;

namespace {

/// Number of sampled columns if there are no side lines. Heuristic.
constexpr int kPlaces = 8;

/// Mean length of the walls: their area over the mean length of their rims.
double mean_length(const Model& model, const LinkingSurface& link)
{
    double area = 0;
    for (const FaceId wall : link.walls) area += face_area(model, wall);
    return 2 * area / (link.source.length() + link.target.length());
}

/// Whether the walls are as long as the straight line in so many columns. Longer walls bend or bulge; walls
/// with a waist have less area.
bool are_straight(const Model& model, const LinkingSurface& link, double straight, std::size_t columns,
                  double hardly_longer)
{
    return std::abs(mean_length(model, link) * static_cast<double>(columns) - straight) <
           hardly_longer * straight;
}

std::vector<Vec3> straight_column(const LinkingSurface& link, const RimSegment& segment, int steps)
{
    const double end = link.target.length();
    const std::array<double, 1> low{segment.source_from};
    const std::array<double, 1> high{segment.target_from >= end ? segment.target_from - end
                                                                : segment.target_from};
    const Vec3 from = link.source.points(low).front(), to = link.target.points(high).front();
    std::vector<Vec3> points;
    for (int i = 0; i <= steps; ++i) points.emplace_back(from + static_cast<double>(i) / steps * (to - from));
    return points;
}

std::vector<Vec3> mapped_column(const Model& model, const LinkingMap& map, double s, int steps)
{
    std::vector<Vec3> points;
    for (int i = 0; i <= steps; ++i) {
        const WallPosition place = map.locate(s, map.from_even(static_cast<double>(i) / steps));
        points.push_back(points_at(model, place.face, std::array{place.at}).front());
    }
    return points;
}

} // namespace

std::vector<std::vector<Vec3>> wall_columns(const OpenVolume& volume, const LinkingSurface& link, int steps,
                                            const RunContext& context, double hardly_longer)
{
    std::vector<std::vector<Vec3>> columns;
    for (const LinkingLine& line : link.lines) {
        const Chain chain(volume.model, line.line.uses);
        std::vector<double> at;
        for (int i = 0; i <= steps; ++i) at.push_back(chain.length() * i / steps);
        columns.push_back(chain.points(at));
    }
    if (!link.lines.empty()) return columns;
    double straight = 0;
    for (const RimSegment& segment : link.segments) {
        columns.push_back(straight_column(link, segment, steps));
        straight += (columns.back().back() - columns.back().front()).norm();
    }
    if (are_straight(volume.model, link, straight, columns.size(), hardly_longer)) return columns;
    const LinkingMap map(volume, link, true, context);
    columns.clear();
    for (int k = 0; k < kPlaces; ++k)
        columns.push_back(mapped_column(volume.model, map, (k + 0.5) / kPlaces, steps));
    return columns;
}

bool walls_bend(const OpenVolume& volume, const LinkingSurface& link)
{
    double straight = 0;
    for (const RimSegment& segment : link.segments) {
        const std::vector<Vec3> column = straight_column(link, segment, 1);
        straight += (column.back() - column.front()).norm();
    }
    return !are_straight(volume.model, link, straight, link.segments.size(), kAnyLonger);
}

} // namespace lacuna::surface
