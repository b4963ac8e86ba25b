// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::surface {

/// Curvature of a face at a vertex of its facets.
struct PointCurvature {
    Vec3 point;
    double most = 0;       ///< larger absolute principal curvature; 0: too flat to affect any size
    double sum = 0;        ///< sum of the absolute principal curvatures [1 / model length]
    double area = 0;       ///< a third of the facets at the point [model length²]
    double least_size = 0; ///< lower bound of the size: half the shortest facet side at the point; 0 for a
                           ///< face with an exact surface
};

/// The facets' curvature tensor (@cite cohensteiner_2003_tensor) at each vertex, over the facets at the
/// vertex and at its neighbours, in the order of `corner_points()`. Empty for a plane. The angle between two
/// facets does not count if it is larger than `crease` [radian].
std::vector<PointCurvature> facet_curvature(const topology::Model& model, FaceId face,
                                            double crease = kInfinity);

} // namespace lacuna::surface
