// SPDX-License-Identifier: MIT
#include <lacuna/topology/shared/cone_shape.h>

#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/spread.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lacuna::topology {

FacetNormals facet_normals(const Model& model, FaceId face)
{
    FacetNormals found;
    for (const Triangle& t : model[face].triangles) {
        const Vec3 n = (model.at(t[1]) - model.at(t[0])).cross(model.at(t[2]) - model.at(t[0]));
        if (!(n.norm() > 0)) continue;
        found.normals.push_back(n.normalized());
        found.areas.push_back(n.norm());
    }
    return found;
}

std::vector<Index> corner_points(const Face& face)
{
    std::vector<Index> used;
    for (const Triangle& t : face.triangles) used.insert(used.end(), t.begin(), t.end());
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
}

std::optional<ConeShape> cone_shape(const Model& model, FaceId id)
{
    const Face& face = model[id];
    if (face.kind == "plane" || face.kind == "sphere") return {};
    const auto [normals, areas] = facet_normals(model, id);
    if (normals.size() < 4) return {};
    const geometry::Spread spread = geometry::spread_of(normals, areas);
    // Normals that are nearly parallel define no axis.
    if (spread.square[0] > kAlikeSizes || spread.square[1] < kParallel * kParallel) return {};
    ConeShape cone;
    cone.axis = spread.axis.col(0);
    const double lean = std::abs(spread.centre.dot(cone.axis));
    if (lean < kParallel || lean > 1 - kFlatShare) return {}; // a cylinder or a plane
    // A point p of the cone at the height h along the axis is at the distance s h + t from the axis, with a
    // slope s. If the axis goes through c, |p|² - 2 c·p + |c|² = (s h + t)², with p and c taken normal to the
    // axis. The slope follows from the normals, so this is linear in c and two other unknowns. Normals of
    // facets are less accurate than corners, so the slope is then fitted to the corners about this axis.
    const std::vector<Index> used = corner_points(face);
    const auto count = static_cast<Eigen::Index>(used.size());
    const Vec3 origin = model.at(used.front());
    const Eigen::Matrix<double, 3, 2> across = spread.axis.rightCols<2>();
    Eigen::MatrixXd left(count, 4), line(count, 2);
    Eigen::VectorXd right(count);
    const double square = lean * lean / (1 - lean * lean);
    for (Eigen::Index p = 0; p < count; ++p) {
        const Vec3 from = model.at(used[static_cast<std::size_t>(p)]) - origin;
        const Vec2 q = across.transpose() * from;
        const double h = from.dot(cone.axis);
        left.row(p) << 2 * q.x(), 2 * q.y(), h, 1;
        right[p] = q.squaredNorm() - square * h * h;
        line.row(p) << h, 1;
    }
    const Eigen::VectorXd found = geometry::least_squares(left, right);
    const Vec2 centre = found.head<2>();
    const Eigen::VectorXd radius = ((left.leftCols<2>() / 2).rowwise() - centre.transpose()).rowwise().norm();
    const Eigen::Vector2d fit = geometry::least_squares(line, radius);
    if (!(std::abs(fit[0]) > kParallel)) return {};
    cone.least_radius = radius.minCoeff();
    cone.largest_radius = radius.maxCoeff();
    if (!((line * fit - radius).cwiseAbs().maxCoeff() <= kAlikeSizes * cone.largest_radius)) return {};
    cone.half_angle = std::atan(std::abs(fit[0])) * 180 / std::numbers::pi;
    cone.apex = origin + across * centre - fit[1] / fit[0] * cone.axis;
    if (fit[0] < 0) cone.axis = -cone.axis;
    return cone;
}

} // namespace lacuna::topology
