// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/sweep/assembly.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

/// Faces with the same mesh up to a motion. Internal to this folder.
namespace lacuna::sweep {

/// Two faces, and a motion that moves one onto the other.
struct PeriodicFaces {
    std::size_t a = 0, b = 0; ///< indices of two members, which may be equal
    FaceId face_a, face_b;
    /// Moves `face_a` onto `face_b`; the linear part of a translation is exactly the identity.
    Eigen::Isometry3d onto;
    std::vector<std::pair<EdgeId, EdgeId>> edges; ///< edges of `face_a` and their images
    std::size_t pair = 0;                         ///< index in the list of requests
};

/// The pairs of faces for which members request the same mesh, each with the edges around both faces.
///
/// If no motion is given, a translation is tried first, then rotations. Of the rotations that fit, the one
/// with the smallest angle is used. A rotation fits if it moves
/// - the centre of the first side's edges to the centre of the second side's edges,
/// - the mean outward normal of the first side to the mean inward normal of the second side,
/// - every edge of the first side to an edge of the second side.
///
/// The motion is then refined by a fit to the ends and centres of all edges.
/// @param grid  from `grid_of()`: translations are rounded to it.
/// @throw InvalidInput "sweep.periodic_faces"  one side of a pair names no swept face, or no motion moves one
///         side onto the other; names both sides and the misfit.
std::vector<PeriodicFaces> periodic_faces(std::span<const AssemblyMember> members, double grid,
                                          const RunContext& context);

/// Spacing of a grid of coordinates, a power of two. Sums and halves of grid coordinates are exact up to four
/// times the members' coordinates. Moving a grid point by a grid translation is therefore exact, and a point
/// reached by several translations has the same bits whatever their order.
double grid_of(std::span<const AssemblyMember> members);
inline Vec3 on_grid(const Vec3& p, double grid) { return (p / grid).array().round() * grid; }

inline bool is_translation(const Eigen::Isometry3d& motion)
{
    return motion.linear() == Eigen::Matrix3d::Identity();
}

/// A point and its image.
struct Tie {
    std::size_t from = 0, to = 0;
    const Eigen::Isometry3d* onto = nullptr;
};
/// Move tied points to their images under the motions. In each connected set, images are computed starting
/// from the first fixed point. If no point is fixed, they start from the first point, which is rounded to the
/// grid if all motions are translations. Fixed points do not move.
void tie_points(std::vector<Vec3>& places, const std::vector<char>& fixed, std::span<const Tie> ties,
                double grid);

} // namespace lacuna::sweep
