// SPDX-License-Identifier: MIT
#include <lacuna/closure/detail/membranes.h>

#include <lacuna/closure/detail/flat_fill.h>
#include <lacuna/closure/detail/rim_quadrics.h>
#include <lacuna/core/shared/criteria.h>
#include <lacuna/geometry/newell.h>
#include <lacuna/topology/shared/face_parts.h>
#include <lacuna/topology/shared/face_plane.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace lacuna::closure {

using namespace topology;

namespace {

/// Largest distance of a face from the quadric of its rim at which the face counts as near, as a share of
/// half the range of the face's heights. A higher value would accept a membrane over the rim of two planes,
/// although the membrane is far from both; a lower one would reject coarse facets.
constexpr double kNearIt = 0.2;

/// The size of a face along the axes of its mean plane, and along its normal [model length].
Vec3 extent_of(const Model& model, FaceId face)
{
    const geometry::Plane plane = mean_plane(model, face);
    Eigen::AlignedBox3d box;
    for (const Index p : corners_of(model[face])) {
        const Vec2 place = geometry::to_plane(plane, model.at(p));
        box.extend(Vec3(place.x(), place.y(), geometry::height(plane, model.at(p))));
    }
    return box.sizes();
}

} // namespace

bool is_about_flat(const Model& model, FaceId face)
{
    const Vec3 extent = extent_of(model, face);
    return extent.z() / 2 <= kParallel * extent.head<2>().norm();
}

bool bends_as_rim(const Model& model, FaceId face)
{
    if (!(face_area_vector(model, face).norm() > 0)) return false;
    // Cones, balls and steps go through any two circles on one axis.
    if (model[face].loops.size() > 1 && has_flat_loops(model, face)) return false;
    const geometry::Plane plane = mean_plane(model, face);
    const double off = kNearIt * extent_of(model, face).z() / 2;
    const RimShapes shapes = shapes_of_rim(model, model[face].loops, plane);
    return std::ranges::any_of(shapes.told, [&](const QuadricSheet& sheet) {
        return std::ranges::all_of(corners_of(model[face]), [&](Index p) {
            const auto told = sheet.height(geometry::to_plane(plane, model.at(p)));
            return told && std::abs(*told - geometry::height(plane, model.at(p))) <= off;
        });
    });
}

bool is_membrane(const Model& model, FaceId face)
{
    return model[face].geometry == Geometry::newell && !is_about_flat(model, face) &&
           !bends_as_rim(model, face);
}

std::vector<FaceId> membranes(const Model& model, const std::vector<FaceId>& void_faces)
{
    std::vector<FaceId> found;
    for (const FaceId face : void_faces)
        if (is_membrane(model, face)) found.push_back(face);
    return found;
}

} // namespace lacuna::closure
