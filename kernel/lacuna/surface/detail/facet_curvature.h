// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/shared/constants.h>
#include <lacuna/topology/model.h>

#include <vector>

namespace lacuna::surface {

/// Curvature of a face at a vertex of its facets.
struct PointCurvature {
    Vec3 point;
    double most = 0;       ///< larger absolute principal curvature; 0: too flat to matter for any size
    double sum = 0;        ///< sum of the absolute principal curvatures [1 / model length]
    double area = 0;       ///< a third of the facets at the point [model length²]
    double least_size = 0; ///< lower bound of the size: half the shortest facet side at the point; 0 for a
                           ///< face with an exact surface
};

/// The facets' curvature tensor (@cite cohensteiner_2003_tensor) over the facets at each vertex and at its
/// neighbours, in the order of `corner_points()`; nothing for a plane. Facets that turn by more than `crease`
/// [radian] do not count as a bend.
std::vector<PointCurvature> facet_curvature(const topology::Model& model, FaceId face,
                                            double crease = kInfinity);

} // namespace lacuna::surface
