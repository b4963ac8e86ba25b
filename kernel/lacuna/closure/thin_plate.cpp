// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/thin_plate.h>

#include <lacuna/geometry/newell.h>
#include <lacuna/geometry/polyline.h>
#include <lacuna/topology/face_plane.h>
#include <lacuna/topology/use_places.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <vector>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Places on a rim that the plate goes through: teeth have several each. The work grows with its cube.
constexpr std::size_t kPlaces = 256;

/// A thin plate over a plane: a sum of r² log r round its places, and a plane.
struct ThinPlate {
    std::vector<Vec2> places; ///< divided by `unit`
    double unit = 1;          ///< [model length]
    Eigen::VectorXd weight;   ///< of each place, then of 1, x and y

    [[nodiscard]] Eigen::RowVectorXd terms_at(const Vec2& place) const
    {
        const Vec2 at = place / unit;
        const auto n = static_cast<Eigen::Index>(places.size());
        Eigen::RowVectorXd terms(n + 3);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double square = (at - places[static_cast<std::size_t>(i)]).squaredNorm();
            terms(i) = square > 0 ? square * std::log(square) : 0;
        }
        terms.tail<3>() << 1, at.x(), at.y();
        return terms;
    }
    [[nodiscard]] double height(const Vec2& place) const { return terms_at(place).dot(weight); }
};

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
        system.row(i) = plate.terms_at(geometry::to_plane(plane, points[static_cast<std::size_t>(i)]));
        right(i) = geometry::height(plane, points[static_cast<std::size_t>(i)]);
    }
    system.bottomRows<3>() = system.rightCols<3>().transpose();
    plate.weight = system.partialPivLu().solve(right);
    return plate;
}

} // namespace

double beside_thin_plate(const Model& model, FaceId face)
{
    const geometry::Plane plane = geometry::plane_across(face_centroid(model, face),
                                                         face_area_vector(model, face));
    std::vector<Vec3> rim;
    for (const Loop& loop : model[face].loops) {
        const std::vector<Vec3> along = geometry::even_places(use_places(model, loop.uses),
                                                              kPlaces / model[face].loops.size() + 1);
        rim.insert(rim.end(), along.begin(), along.end() - 1);
    }
    const ThinPlate plate = plate_through(plane, rim);
    double sum = 0;
    for (const Triangle& t : model[face].triangles) {
        const Vec3 &a = model.at(t[0]), &b = model.at(t[1]), &c = model.at(t[2]);
        const Vec3 middle = (a + b + c) / 3;
        const double off = plate.height(geometry::to_plane(plane, middle)) - geometry::height(plane, middle);
        sum += std::abs(off * (b - a).cross(c - a).dot(plane.normal)) / 2;
    }
    return sum;
}

} // namespace lacuna::closure
