// SPDX-License-Identifier: MIT
#include <lacuna/sweep/detail/surface_smoothing.h>

#include <lacuna/core/shared/constants.h>
#include <lacuna/core/shared/limits.h>
#include <lacuna/core/shared/parallel.h>
#include <lacuna/geometry/shared/pattern_search.h>

#include <Eigen/LU>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

namespace lacuna::sweep {

namespace {

const Vec3& at(std::span<const Vec3> points, Index i) { return points[index(i)]; }

/// The tangential part of a move.
Vec3 along(const Vec3& move, const Vec3& normal)
{
    const double squared = normal.squaredNorm();
    return squared > 0 ? Vec3(move - normal * (normal.dot(move) / squared)) : move;
}

/// Change the weights of a node's neighbours so that their weighted mean is the node itself, seen along the
/// node's normal. The sum of the weights stays the same.
void hold_in_place(std::span<const Vec3> nodes, std::span<const Index> neighbours, const Vec3& node,
                   const Vec3& normal, std::span<double> weights)
{
    if (!(normal.norm() > 0)) return;
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.normalized().cross(u);
    const auto seen = [&](Index n) {
        const Vec3 step = at(nodes, n) - node;
        return Vec2(u.dot(step), v.dot(step));
    };
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    Vec2 mean = Vec2::Zero();
    for (std::size_t k = 0; k < neighbours.size(); ++k) mean += weights[k] / sum * seen(neighbours[k]);
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const Vec2 off = seen(neighbours[k]) - mean;
        spread += weights[k] / sum * off * off.transpose();
    }
    Eigen::Matrix2d inverse;
    bool invertible = false;
    double determinant = 0;
    spread.computeInverseAndDetWithCheck(inverse, determinant, invertible);
    if (!invertible) return;
    std::vector<double> turned(weights.begin(), weights.end());
    const Vec2 pull = inverse * mean;
    for (std::size_t k = 0; k < neighbours.size(); ++k) turned[k] *= 1 - pull.dot(seen(neighbours[k]) - mean);
    // If a new weight is not positive, the original weights are kept, because negative weights could fold the
    // mesh.
    if (std::ranges::all_of(turned, [](double w) { return w > 0; })) {
        std::copy(turned.begin(), turned.end(), weights.begin());
    }
}

} // namespace

std::vector<Vec3> node_normals(std::span<const Quad> quads, std::span<const Vec3> nodes)
{
    std::vector<Vec3> normals(nodes.size(), Vec3::Zero());
    for (const Quad& q : quads) {
        const Vec3 area = (at(nodes, q[2]) - at(nodes, q[0])).cross(at(nodes, q[3]) - at(nodes, q[1]));
        for (std::size_t k = 0; k < mesh::corner_count(q); ++k) normals[index(q[k])] += area;
    }
    return normals;
}

double quad_quality(const Quad& quad, std::span<const Vec3> nodes, std::span<const Vec3> normals)
{
    Vec3 normal = (at(nodes, quad[2]) - at(nodes, quad[0])).cross(at(nodes, quad[3]) - at(nodes, quad[1]));
    Vec3 around = Vec3::Zero();
    for (const Index node : quad) around += at(normals, node);
    const double length = normal.norm();
    if (!(length > 0)) return -1;
    normal /= normal.dot(around) < 0 ? -length : length;

    double worst = 1;
    const std::size_t corners = mesh::corner_count(quad);
    // The factor gives an equilateral triangle the quality of a square.
    const double best = corners == 3 ? 2 * std::numbers::inv_sqrt3 : 1;
    for (std::size_t i = 0; i < corners; ++i) {
        const Vec3 out = at(nodes, quad[(i + 1) % corners]) - at(nodes, quad[i]);
        const Vec3 in = at(nodes, quad[(i + corners - 1) % corners]) - at(nodes, quad[i]);
        const double sides = out.norm() * in.norm();
        worst = std::min(worst, sides > 0 ? best * out.cross(in).dot(normal) / sides : -1.0);
    }
    return worst;
}

double worst_quad(std::span<const Quad> quads, std::span<const Vec3> nodes, const RunContext& context)
{
    const std::vector<Vec3> normals = node_normals(quads, nodes);
    return parallel_min(context, quads.size(), kBetweenPolls, 1, [&](std::size_t begin, std::size_t end) {
        double worst = 1;
        for (std::size_t q = begin; q < end; ++q)
            worst = std::min(worst, quad_quality(quads[q], nodes, normals));
        return worst;
    });
}

void project_nodes(std::vector<Vec3>& nodes, std::span<const Index> which, const SurfaceProjector& project)
{
    std::vector<Vec3> points;
    points.reserve(which.size());
    for (const Index node : which) points.push_back(at(nodes, node));
    if (!points.empty()) project(points);
    for (std::size_t k = 0; k < points.size(); ++k) nodes[index(which[k])] = points[k];
}

SurfaceSmoother::SurfaceSmoother(const mesh::QuadMesh& model, const NodeGraph& graph,
                                 std::span<const double> weights, const HarmonicSpread& spread,
                                 std::span<const Index> free_nodes, const SurfaceProjector& project)
    : model_(model),
      graph_(graph),
      spread_(spread),
      free_nodes_(free_nodes),
      project_(project),
      weights_(weights.begin(), weights.end())
{
    const std::vector<Vec3> normals = node_normals(model.quads, model.nodes);
    for (const Index node : free_nodes) {
        const std::size_t i = index(node);
        is_free_[i] = 1;
        const std::span<const Index> neighbours = graph.of(i);
        hold_in_place(model.nodes, neighbours, model.nodes[i], normals[i],
                      std::span(weights_).subspan(index(graph.begin[i]), neighbours.size()));
    }
}

std::vector<Vec3> SurfaceSmoother::relax(std::vector<Vec3> nodes, double good_enough,
                                         const RunContext& context) const
{
    std::vector<Vec3> best = nodes;
    double best_worst = worst_quad(model_.quads, nodes, context);
    std::vector<Vec3> load(nodes.size());
    for (int round = 0; round < kMostSteps && best_worst < good_enough; ++round) {
        check_cancelled(context);
        const std::vector<Vec3> normals = node_normals(model_.quads, nodes);
        for (const Index node : free_nodes_) {
            const std::size_t i = index(node);
            const std::span<const Index> neighbours = graph_.of(i);
            Vec3 pull = Vec3::Zero();
            for (std::size_t k = 0; k < neighbours.size(); ++k) {
                pull += weights_[index(graph_.begin[i]) + k] * (at(nodes, neighbours[k]) - nodes[i]);
            }
            load[i] = along(pull, normals[i]);
        }
        spread_.solve(load);
        for (const Index node : free_nodes_) {
            const std::size_t i = index(node);
            nodes[i] += along(load[i], normals[i]);
        }
        project_nodes(nodes, free_nodes_, project_);
        const double worst = worst_quad(model_.quads, nodes, context);
        if (worst > best_worst) {
            best_worst = worst;
            best = nodes;
        }
    }
    return best;
}

double SurfaceSmoother::worst_around(std::size_t node, std::span<const Vec3> nodes,
                                     std::span<const Vec3> normals) const
{
    double worst = 1;
    for (const Index q : quads_at_.of(node))
        worst = std::min(worst, quad_quality(model_.quads[index(q)], nodes, normals));
    return worst;
}

/// Free nodes of poor quads, in increasing order.
std::vector<std::size_t> SurfaceSmoother::poor_nodes(std::span<const Vec3> nodes,
                                                     std::span<const Vec3> normals, double good_enough) const
{
    std::vector<std::size_t> poor;
    for (const Quad& quad : model_.quads) {
        if (quad_quality(quad, nodes, normals) >= good_enough) continue;
        for (const Index node : quad) {
            if (is_free_[index(node)] != 0) poor.push_back(index(node));
        }
    }
    std::ranges::sort(poor);
    poor.erase(std::unique(poor.begin(), poor.end()), poor.end());
    return poor;
}

/// Trial position of a node: a step along the surface, in mean lengths of its sides; zero: the mean of its
/// neighbours.
Vec3 SurfaceSmoother::trial_place(std::size_t node, const Vec2& step, std::span<const Vec3> nodes,
                                  const Vec3& normal) const
{
    const std::span<const Index> neighbours = graph_.of(node);
    Vec3 mean = Vec3::Zero();
    double side = 0;
    for (const Index n : neighbours) {
        mean += at(nodes, n) / static_cast<double>(neighbours.size());
        side += (at(nodes, n) - nodes[node]).norm() / static_cast<double>(neighbours.size());
    }
    if (step.isZero(0) || !(normal.norm() > 0)) return mean;
    const Vec3 u = normal.unitOrthogonal();
    const Vec3 v = normal.normalized().cross(u);
    return nodes[node] + side * (step.x() * u + step.y() * v);
}

/// One round of trials for the nodes of poor quads. @return  whether any node moved.
bool SurfaceSmoother::polish_once(std::vector<Vec3>& nodes, double good_enough) const
{
    const std::vector<Vec3> normals = node_normals(model_.quads, nodes);
    const std::vector<std::size_t> poor = poor_nodes(nodes, normals, good_enough);
    if (poor.empty()) return false;

    bool moved = false;
    std::vector<Vec3> places(poor.size());
    std::vector<Vec2> steps{Vec2::Zero()};
    for (double share = geometry::kLongestStep; share >= geometry::kShortestStep;
         share *= geometry::kLongestStep)
        for (const Vec2& way : geometry::all_around()) steps.emplace_back(share * way);
    for (const Vec2& step : steps) {
        for (std::size_t k = 0; k < poor.size(); ++k) {
            places[k] = trial_place(poor[k], step, nodes, normals[poor[k]]);
        }
        project_(places);
        for (std::size_t k = 0; k < poor.size(); ++k) {
            Vec3& node = nodes[poor[k]];
            const double before = worst_around(poor[k], nodes, normals);
            std::swap(node, places[k]);
            if (worst_around(poor[k], nodes, normals) > before)
                moved = true;
            else
                std::swap(node, places[k]);
        }
    }
    return moved;
}

std::vector<Vec3> SurfaceSmoother::polish(std::vector<Vec3> nodes, double good_enough,
                                          const RunContext& context) const
{
    std::vector<Vec3> best = nodes;
    double best_worst = worst_quad(model_.quads, nodes, context);
    for (int round = 0; round < kMostRounds && best_worst < good_enough; ++round) {
        check_cancelled(context);
        if (!polish_once(nodes, good_enough)) break;
        const double worst = worst_quad(model_.quads, nodes, context);
        if (!(worst > best_worst)) break;
        best_worst = worst;
        best = nodes;
    }
    return best;
}

} // namespace lacuna::sweep
