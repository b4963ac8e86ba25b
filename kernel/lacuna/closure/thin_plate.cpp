// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/thin_plate.h>

#include <lacuna/geometry/shared/dense_solve.h>
#include <lacuna/geometry/shared/polyline.h>
#include <lacuna/topology/shared/use_places.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Number of rim points that the plate interpolates: several per tooth of a rough rim. The cost grows with
/// its cube.
constexpr std::size_t kPlaces = 256;

Eigen::RowVectorXd terms_at(const ThinPlate& plate, const Vec2& place)
{
    const Vec2 at = place / plate.unit;
    const auto n = static_cast<Eigen::Index>(plate.places.size());
    Eigen::RowVectorXd terms(n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double square = (at - plate.places[static_cast<std::size_t>(i)]).squaredNorm();
        terms(i) = square > 0 ? square * std::log(square) : 0;
    }
    terms.tail<3>() << 1, at.x(), at.y();
    return terms;
}

ThinPlate plate_through(const geometry::Plane& plane, const std::vector<Vec3>& points)
{
    ThinPlate plate;
    plate.unit = 0;
    for (const Vec3& p : points) {
        plate.places.push_back(geometry::to_plane(plane, p));
        plate.unit = std::max(plate.unit, plate.places.back().norm());
    }
    for (Vec2& place : plate.places) place /= plate.unit;
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + 3, n + 3);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        system.row(i) = terms_at(plate, geometry::to_plane(plane, points[static_cast<std::size_t>(i)]));
        right(i) = geometry::height(plane, points[static_cast<std::size_t>(i)]);
    }
    system.bottomRows<3>() = system.rightCols<3>().transpose();
    plate.weight = geometry::solve_lu(system, right);
    return plate;
}

} // namespace

double ThinPlate::height(const Vec2& place) const { return terms_at(*this, place).dot(weight); }

ThinPlate plate_over(const geometry::Plane& plane, const Model& model, const std::vector<Loop>& loops)
{
    std::vector<Vec3> rim;
    for (const Loop& loop : loops) {
        const std::vector<Vec3> along = geometry::even_places(use_places(model, loop.uses),
                                                              kPlaces / loops.size() + 1);
        rim.insert(rim.end(), along.begin(), along.end() - 1);
    }
    return plate_through(plane, rim);
}

} // namespace lacuna::closure
