// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/core/run_context.h>
#include <lacuna/topology/open_volume.h>

#include <vector>

namespace lacuna::topology {

/// Faces that meet smoothly, as one: what can be an end of a sweep.
struct SmoothPatch {
    std::vector<FaceId> faces; ///< in the model's order
    std::vector<Rim> rims;
    std::vector<VertexId> vertices; ///< of the faces' loops, each once
    std::vector<EdgeId> edges;      ///< of the faces' loops, each once
    long inner_euler = 0;           ///< Euler number without the points and sides that lie on `edges`
    Vec3 normal = Vec3::Zero();     ///< unit mean
    Vec3 centre = Vec3::Zero();
    double area = 0;
    double flatness = 0; ///< length of the summed area vector over the area: 1 for a plane
    double slant = 0;    ///< mean departure from a right angle to its neighbours, as a share of a right angle
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(); ///< sum of area n nᵀ over the facets
    long corners = 0; ///< of its rims, in quarter turns: 4 round a rectangle, 0 round a disc
};

/// Faces that meet at less than this are one patch: a skin cut in pieces, not an end and a wall [degrees].
/// A choice, not a measurement: a chamfer of 45° still parts two patches.
inline constexpr double kSmooth = 30;

/// Mean angle between the two faces of each edge, below 0 where they meet inside a hollow, as their normals
/// say [degrees]; 0 where they run on smoothly or are not two. Near linear in the number of facets.
/// @pre  the model is oriented.
/// @throw Cancelled
std::vector<double> folds_across(const Model& model, const std::vector<std::vector<FaceUse>>& uses,
                                 const RunContext& context);

/// The same without the sign.
std::vector<double> angles_across(const Model& model, const std::vector<std::vector<FaceUse>>& uses,
                                  const RunContext& context);

/// The patches of all faces of a model, in the order of their first faces. Near linear in the number of
/// facets.
/// @param angle  of each edge, by angles_across()
/// @pre  the model is oriented.
/// @throw Cancelled
std::vector<SmoothPatch> smooth_patches(const Model& model, const std::vector<std::vector<FaceUse>>& uses,
                                        const std::vector<double>& angle, const RunContext& context);

} // namespace lacuna::topology
