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

/// Two faces of which a motion moves one onto the other.
struct PeriodicFaces {
    std::size_t a = 0, b = 0; ///< members, which may be one
    FaceId face_a, face_b;
    Eigen::Isometry3d onto; ///< moves `face_a` onto `face_b`; of a translation the linear part is exactly 1
    std::vector<std::pair<EdgeId, EdgeId>> edges; ///< edges of `face_a` and their images
    std::size_t pair = 0;                         ///< index in the list of requests
};

/// The faces that members are asked to mesh alike, each with its image and the edges around both.
///
/// The motion is the given one, or a translation, or else the rotation by the smallest angle: it takes the
/// centre of the edges to the centre, the mean normal out of the volume to the one into it, and edges to
/// edges; a fit to all ends of edges refines it.
/// @param grid  as of `grid_of()`: translations are rounded to it.
/// @throw InvalidInput "sweep.periodic_faces"  a pair of which a side names no face that is swept, or no
///        motion moves one side onto the other; names them and the misfit.
std::vector<PeriodicFaces> periodic_faces(std::span<const AssemblyMember> members, double grid,
                                          const RunContext& context);

/// The distance of numbers of which sums and halves are exact up to four times the members' coordinates: a
/// power of two. A point on this grid moved by a translation on it is exact, so that points that several
/// translations reach in different order are equal bit for bit.
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
/// Move tied points to where the motions take them: in each connected set from its first fixed point, or else
/// from its first point, which is rounded to the grid if all motions are translations. Fixed points stay.
void tie_points(std::vector<Vec3>& places, const std::vector<char>& fixed, std::span<const Tie> ties,
                double grid);

} // namespace lacuna::sweep
