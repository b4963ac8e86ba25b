// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::topology {

/// A connected set of faces that meet at less than `kCreaseAngle`: a candidate for an end of a sweep.
struct SmoothPatch {
    std::vector<FaceId> faces; ///< in the model's order
    std::vector<Rim> rims;
    std::vector<VertexId> vertices; ///< vertices of the faces' loops, without repeats
    std::vector<EdgeId> edges;      ///< edges of the faces' loops, without repeats
    long inner_euler = 0;           ///< Euler number without the points and sides on `edges`
    Vec3 normal = Vec3::Zero();     ///< unit mean normal
    Vec3 centre = Vec3::Zero();
    double area = 0;
    double flatness = 0; ///< length of the summed area vector divided by the area: 1 for a plane
    double slant = 0;    ///< mean deviation of the angle to its neighbours from 90°, as a share of 90°
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); ///< sum of area n nᵀ over the facets
    long corners = 0; ///< sum over the rims' vertices of the turn there in quarter turns: 4 for a rectangle
};

/// For each edge, the mean angle between the normals of its two faces, negative if the edge is concave
/// [degrees]; 0 if the edge does not have two different faces. Near linear in the number of facets.
/// @pre  the model is oriented.
/// @throw Cancelled
std::vector<double> folds_across(const Model& model, const RunContext& context);

/// The absolute values of folds_across().
std::vector<double> angles_across(const Model& model, const RunContext& context);

/// The patches of all faces of a model, in the order of their first faces. Near linear in the number of
/// facets.
/// @param angle  angle at each edge, from angles_across()
/// @pre  the model is oriented.
/// @throw Cancelled
std::vector<SmoothPatch> smooth_patches(const Model& model, const std::vector<double>& angle,
                                        const RunContext& context);

} // namespace lacuna::topology
