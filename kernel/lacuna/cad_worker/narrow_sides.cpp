// SPDX-License-Identifier: GPL-2.0-or-later
#include <lacuna/cad_worker/detail/narrow_sides.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/angle.h>
#include <lacuna/geometry/shared/segment.h>
#include <lacuna/geometry/shared/spread.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace lacuna::cad_worker {

namespace {

/// Largest refinement factor: a whole circle then has 384 segments.
constexpr double kMost = 8;

/// A segment of the polyline of an edge.
struct Side {
    Vec3 from, to;
    std::size_t edge = 0;
    double sag = 0; ///< sag of the curve over the segment [file length]
};

/// Sag of a segment, from the arc through its ends and the next point.
double sag_of(const std::vector<Vec3>& line, std::size_t side)
{
    const auto bend = [&](std::size_t at) {
        if (at == 0 || at + 1 >= line.size()) return 0.0;
        const Vec3 in = line[at] - line[at - 1], out = line[at + 1] - line[at];
        return geometry::angle_between(in, out);
    };
    return (line[side + 1] - line[side]).norm() * std::max(bend(side), bend(side + 1)) / 8;
}

std::vector<Side> sides_of(const CadWire& wire, const std::set<std::size_t>& edges)
{
    std::vector<Side> sides;
    for (const std::size_t e : edges) {
        std::vector<Vec3> line;
        for (const Index p : wire.edges[e].points) line.push_back(wire.points[index(p)]);
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            sides.push_back({line[i], line[i + 1], e, sag_of(line, i)});
    }
    return sides;
}

bool is_flat(const std::vector<Side>& sides)
{
    std::vector<Vec3> ends;
    for (const Side& side : sides) ends.push_back(side.from);
    const Vec3 squares = geometry::spread_of(ends).square;
    return squares[0] <= kFileAccuracy * kFileAccuracy * squares[2];
}

bool share_a_point(const CadEdge& a, const CadEdge& b)
{
    const auto ends = [](const CadEdge& edge, Index p) {
        return edge.points.front() == p || edge.points.back() == p;
    };
    return ends(b, a.points.front()) || ends(b, a.points.back());
}

} // namespace

std::vector<double> narrow_refinement(const CadWire& wire)
{
    std::vector<double> refinement(wire.edges.size(), 1.0);
    for (const CadFaceInfo& face : wire.faces) {
        std::set<std::size_t> edges;
        for (const CadFaceInfo::Side& side : face.sides) {
            for (const std::size_t piece : wire.curves[side.curve].pieces)
                edges.insert(wire.pieces[piece].edge);
        }
        std::vector<Side> sides = sides_of(wire, edges);
        if (edges.size() < 2 || std::ranges::none_of(sides, [](const Side& s) { return s.sag > 0; }) ||
            !is_flat(sides))
            continue;
        std::ranges::sort(sides, {}, [](const Side& side) { return std::min(side.from.x(), side.to.x()); });
        double longest = 0; // largest extent of a segment along x
        for (const Side& side : sides) longest = std::max(longest, std::abs(side.to.x() - side.from.x()));
        for (const Side& side : sides) {
            if (!(side.sag > 0)) continue;
            const Vec3 middle = (side.from + side.to) / 2;
            double near = side.sag / kSameVolume; // other edges farther away need no refinement
            auto other = std::ranges::lower_bound(sides, middle.x() - near - longest, {}, [](const Side& s) {
                return std::min(s.from.x(), s.to.x());
            });
            for (; other != sides.end() && std::min(other->from.x(), other->to.x()) <= middle.x() + near;
                 ++other) {
                if (other->edge == side.edge || share_a_point(wire.edges[other->edge], wire.edges[side.edge]))
                    continue;
                near = std::min(near, geometry::distance_to_segment(middle, other->from, other->to));
            }
            // The sag is inversely proportional to the square of the number of points.
            const double wanted = near > 0 ? std::sqrt(side.sag / (kSameVolume * near)) : kMost;
            refinement[side.edge] = std::max(refinement[side.edge], std::min(wanted, kMost));
        }
    }
    return refinement;
}

} // namespace lacuna::cad_worker
