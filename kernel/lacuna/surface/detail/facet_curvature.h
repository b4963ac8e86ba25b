// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::surface {

/// Curvature of a face at a vertex of its facets.
struct PointCurvature {
    Vec3 point;
    /// Larger absolute principal curvature [1 / model length]; 0: too small to affect any size.
    double most = 0;
    double sum = 0;        ///< sum of the absolute principal curvatures [1 / model length]
    double area = 0;       ///< a third of the area of the facets at the point [model length²]
    double least_size = 0; ///< lower bound of the size: half the shortest facet side at the point; 0 for a
                           ///< face with an exact surface
};

/// The curvature at each vertex of a face's facets, in the order of `corner_points()`. It is computed from
/// the curvature tensor (@cite cohensteiner_2003_tensor) of the facets at the vertex and at its neighbours.
/// @param crease  larger angles between two facets are creases and do not count as curvature [radian].
/// @return  empty for a plane.
std::vector<PointCurvature> facet_curvature(const topology::Model& model, FaceId face,
                                            double crease = kInfinity);

} // namespace lacuna::surface
