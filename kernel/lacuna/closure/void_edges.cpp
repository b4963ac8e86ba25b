// SPDX-License-Identifier: MIT
#include <lacuna/closure/void_edges.h>

#include <lacuna/geometry/polyline.h>
#include <lacuna/matching/side_lines.h>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Segments of a void edge when nothing near tells how fine: enough for a smooth bend.
constexpr int kMostSegments = 64;

/// A side line as a curve with a frame that turns with it and never about it (double reflection, Wang et al. 2008).
struct FramedCurve {
    std::vector<Vec3> points;
    std::vector<double> arc;
    std::vector<Eigen::Matrix3d> frames;
};

FramedCurve framed(const Model& model, const matching::SideLine& line)
{
    FramedCurve curve;
    for (const EdgeUse& use : line.uses) {
        for (const Index p : use_points(model, use)) {
            if (curve.points.empty() || (model.at(p) - curve.points.back()).norm() > 0)
                curve.points.push_back(model.at(p));
        }
    }
    curve.arc = geometry::arc_lengths(curve.points);
    const std::size_t n = curve.points.size();
    const auto tangent = [&](std::size_t i) {
        const Vec3 ahead = i + 1 < n ? (curve.points[i + 1] - curve.points[i]).normalized() : Vec3::Zero();
        const Vec3 behind = i > 0 ? (curve.points[i] - curve.points[i - 1]).normalized() : Vec3::Zero();
        return (ahead + behind).stableNormalized();
    };
    Vec3 t = tangent(0);
    Vec3 u = t.unitOrthogonal();
    for (std::size_t i = 0; i < n; ++i) {
        if (i > 0) {
            const Vec3 step = curve.points[i] - curve.points[i - 1];
            const Vec3 u_left = u - 2 * step.dot(u) / step.squaredNorm() * step;
            const Vec3 t_left = t - 2 * step.dot(t) / step.squaredNorm() * step;
            const Vec3 t_next = tangent(i);
            const Vec3 across = t_next - t_left;
            u = across.squaredNorm() > 0 ? Vec3(u_left - 2 * across.dot(u_left) / across.squaredNorm() * across) : u_left;
            t = t_next;
        }
        u = (u - u.dot(t) * t).stableNormalized();
        Eigen::Matrix3d frame;
        frame << u, t.cross(u), t;
        curve.frames.push_back(frame);
    }
    return curve;
}

/// The place at fraction f of the curve, with `from` and `to` as its ends.
Vec3 carried(const FramedCurve& curve, double f, const Vec3& from, const Vec3& to)
{
    const geometry::PolylinePlace at = geometry::place_at(curve.arc, f * curve.arc.back());
    const std::size_t i = at.segment;
    const Vec3 point = curve.points[i] + at.fraction * (curve.points[i + 1] - curve.points[i]);
    const Vec3 start = curve.frames.front().transpose() * (from - curve.points.front());
    const Vec3 end = curve.frames.back().transpose() * (to - curve.points.back());
    const Vec3 offset = (1 - f) * start + f * end;
    const Eigen::Quaterniond a(curve.frames[i]), b(curve.frames[i + 1]);
    return point + a.slerp(at.fraction, b) * offset;
}

/// Mean spacing of the facet points on the edges at a vertex.
double spacing_at(const Model& model, VertexId vertex)
{
    double sum = 0;
    std::size_t segments = 0;
    for (std::size_t e = 0; e < model.edges.size(); ++e) {
        if (model.edges[e].from != vertex && model.edges[e].to != vertex) continue;
        sum += edge_length(model, EdgeId(e));
        segments += model.edges[e].points.size() - 1;
    }
    return segments > 0 ? sum / static_cast<double>(segments) : 0;
}

} // namespace

std::vector<EdgeId> make_void_edges(OpenVolume& volume, const matching::Match& match, EdgeShape shape)
{
    Model& model = volume.model;
    std::vector<bool> on_wall(model.vertices.size(), false);
    for (const FaceId wall : volume.faces(Role::wall)) {
        for (const Loop& loop : model[wall].loops) {
            for (const EdgeUse& use : loop.uses) {
                on_wall[model[use.edge].from.index()] = true;
                on_wall[model[use.edge].to.index()] = true;
            }
        }
    }
    std::vector<FramedCurve> lines;
    if (shape == EdgeShape::follow) {
        for (const matching::SideLine& line : matching::side_lines(volume))
            lines.push_back(framed(model, line));
    }

    std::vector<EdgeId> made;
    for (const auto& [source, target] : match.vertices) {
        if (on_wall[source.index()] || on_wall[target.index()]) continue;
        const Vec3 from = model.at(model[source].point);
        const Vec3 to = model.at(model[target].point);
        // The two nearest side lines, the nearer one counting more.
        std::sort(lines.begin(), lines.end(), [&](const FramedCurve& a, const FramedCurve& b) {
            return (a.points.front() - from).squaredNorm() < (b.points.front() - from).squaredNorm();
        });
        const std::size_t near = std::min<std::size_t>(2, lines.size());

        const double spacing = spacing_at(model, source);
        const double wanted = spacing > 0 ? (to - from).norm() / spacing : 1;
        int segments = static_cast<int>(std::clamp(std::round(wanted), 1.0, static_cast<double>(kMostSegments)));
        if (near > 0) segments = std::max<int>(segments, static_cast<int>(lines.front().points.size()) - 1);

        Edge edge;
        edge.origin = Origin::made_void;
        edge.tag = static_cast<int>(made.size()) + 1;
        edge.from = source;
        edge.to = target;
        edge.points.push_back(model[source].point);
        for (int i = 1; i < segments; ++i) {
            const double f = static_cast<double>(i) / segments;
            Vec3 place = (1 - f) * from + f * to;
            if (near > 0) {
                Vec3 sum = Vec3::Zero();
                double weights = 0;
                for (std::size_t k = 0; k < near; ++k) {
                    const double weight = 1 / std::max((lines[k].points.front() - from).norm(), model.tolerance);
                    sum += weight * carried(lines[k], f, from, to);
                    weights += weight;
                }
                place = sum / weights;
            }
            edge.points.push_back(static_cast<Index>(model.points.size()));
            model.points.push_back(place);
        }
        edge.points.push_back(model[target].point);
        made.emplace_back(model.edges.size());
        model.edges.push_back(std::move(edge));
    }
    return made;
}

} // namespace lacuna::closure
