// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/member_edge.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/surface/shared/seeds.h>
#include <lacuna/sweep/detail/rim_arcs.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lacuna::sweep {

MemberEdge member_edge(const topology::Model& model, std::size_t member, EdgeId edge,
                       const Eigen::Isometry3d& by)
{
    std::vector<Vec3> line = surface::edge_line(model, edge);
    for (Vec3& p : line) p = by * p;
    MemberEdge result;
    for (const Vec3& p : line) result.box.extend(p);
    const std::vector<double> arc = geometry::arc_lengths(line);
    result.member = member;
    result.edge = edge;
    result.length = arc.back();
    result.from = line.front();
    result.to = line.back();
    result.middle = geometry::point_at(line, arc, arc.back() / 2);
    result.sag = geometry::sag(line);
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        result.centre += (arc[i + 1] - arc[i]) / arc.back() * (line[i] + line[i + 1]) / 2;
    result.closed = model[edge].points.front() == model[edge].points.back();
    return result;
}

bool is_same(const MemberEdge& a, const MemberEdge& b, double tolerance)
{
    // Facets of different fineness have slightly different midpoints.
    const double slack = tolerance + kAlikeSizes * a.length;
    if (a.closed != b.closed || std::abs(a.length - b.length) > slack) return false;
    if (a.closed) {
        // Boxes around two sets of chords of one curve differ by at most the sag of the chords, and mean
        // points by much less.
        const double off = tolerance + 2 * std::max(a.sag, b.sag);
        return (a.box.min() - b.box.min()).norm() <= off && (a.box.max() - b.box.max()).norm() <= off &&
               (a.centre - b.centre).norm() <= tolerance + kArcError * std::max(a.sag, b.sag);
    }
    const bool along = (a.from - b.from).norm() <= tolerance && (a.to - b.to).norm() <= tolerance;
    const bool back = (a.from - b.to).norm() <= tolerance && (a.to - b.from).norm() <= tolerance;
    return (along || back) && (a.middle - b.middle).norm() <= slack;
}

} // namespace lacuna::sweep
