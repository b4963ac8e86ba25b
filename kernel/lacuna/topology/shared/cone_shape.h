// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/model.h>

#include <cmath>
#include <optional>
#include <vector>

namespace lacuna::topology {

/// Unit normals and relative areas of a face's facets. Facets without area are left out.
struct FacetNormals {
    std::vector<Vec3> normals;
    std::vector<double> areas;
};
FacetNormals facet_normals(const Model& model, FaceId face);

/// The corners of a face's facets, ascending.
std::vector<Index> corner_points(const Face& face);

/// The cone that a face lies on.
struct ConeShape {
    double half_angle = 0;     ///< between axis and surface, in (0, 90) [degrees]
    Vec3 apex = Vec3::Zero();  ///< the face need not reach it
    Vec3 axis = Vec3::UnitZ(); ///< unit, from the apex into the cone
    double least_radius = 0;   ///< smallest radius of the face [model length]
    double largest_radius = 0; ///< largest radius of the face [model length]
    /// Distance of a point from the surface [model length]; negative inside.
    [[nodiscard]] double height(const Vec3& p) const
    {
        const double along = (p - apex).dot(axis), slope = half_angle * kDegree;
        return (p - apex - along * axis).norm() * std::cos(slope) - along * std::sin(slope);
    }
};

/// The cone of a face from its facets: the axis has the same angle to all normals, and apex and slope are
/// fitted to the facets' corners by least squares.
/// @return empty in these cases:
///         - the face is a plane, a sphere or a cylinder;
///         - there is no axis with the same angle to all normals;
///         - a corner is off the cone by more than a hundredth of the largest radius;
///         - there are fewer than four facets, or their normals turn by less than a few degrees.
/// @note  O(facets).
std::optional<ConeShape> cone_shape(const Model& model, FaceId face);

} // namespace lacuna::topology
