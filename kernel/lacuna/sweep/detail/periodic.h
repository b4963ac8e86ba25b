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
    Eigen::Isometry3d onto; ///< moves `face_a` onto `face_b`; for a translation the linear part is exactly
                            ///< the identity
    std::vector<std::pair<EdgeId, EdgeId>> edges; ///< edges of `face_a` and their images
    std::size_t pair = 0;                         ///< index in the list of requests
};

/// The faces for which members request the same mesh, each with its image and the edges around both.
///
/// The motion is the given one, or a translation, or else the rotation by the smallest angle. A rotation
/// takes the centre of one side's edges to that of the other, the mean outward normal to the mean inward
/// normal, and edges to edges; a fit to all ends of edges refines it.
/// @param grid  from `grid_of()`: translations are rounded to it.
/// @throw InvalidInput "sweep.periodic_faces"  a pair with a side that names no swept face, or with sides
///     that no motion moves onto each other; names them and the misfit.
std::vector<PeriodicFaces> periodic_faces(std::span<const AssemblyMember> members, double grid,
                                          const RunContext& context);

/// Spacing of a grid of numbers, a power of two: sums and halves of grid numbers are exact up to four times
/// the members' coordinates. A grid point moved by a grid translation is therefore exact, and points reached
/// by several translations in different order are equal bit for bit.
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
/// Move tied points to the images under their motions. In each connected set the images start from the first
/// fixed point, or else from the first point, which is rounded to the grid if all motions are translations.
/// Fixed points stay.
void tie_points(std::vector<Vec3>& places, const std::vector<char>& fixed, std::span<const Tie> ties,
                double grid);

} // namespace lacuna::sweep
